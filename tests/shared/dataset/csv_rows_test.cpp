#include "shared/dataset/csv_rows.hpp"

#include <gmock/gmock.h>

#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class CsvRowsTest : public DatasetFixture {};

TEST_F(CsvRowsTest, KnowsHeaderLinesAndRowsApart) {
  const CsvRows rows =
      CsvRows::read(write("a.csv", "#timestamp [ns], filename\r\n\n1, a.png\r\n# remark\n2 ,b.png\n"));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_THAT(rows.header(), ElementsAre("timestamp [ns]", "filename"));
  EXPECT_EQ(rows.column("timestamp"), 0U);
  EXPECT_EQ(rows.column("filename"), 1U);
  EXPECT_EQ(rows.column("file"), std::nullopt);
  EXPECT_THAT(rows.row(1), ElementsAre("2", "b.png"));
  EXPECT_THAT(rows.place(1), HasSubstr("a.csv:5"));
}

TEST_F(CsvRowsTest, AFileWithoutHeaderHasOnlyRows) {
  const CsvRows rows = CsvRows::read(write("a.csv", "nan,1\n2,3\n"));
  EXPECT_EQ(rows.size(), 2U);
  EXPECT_TRUE(rows.header().empty());
}

TEST_F(CsvRowsTest, AMissingOrEmptyFileIsAnError) {
  EXPECT_THAT(error_of<DatasetError>([&] { CsvRows::read(folder_ / "no.csv"); }),
              HasSubstr("no.csv: can't be read"));
  EXPECT_THAT(error_of<DatasetError>([&] { CsvRows::read(folder_); }), HasSubstr("can't be read"));
  EXPECT_THAT(error_of<DatasetError>([&] { CsvRows::read(write("a.csv", "stamp_ns,file\n\n")); }),
              HasSubstr("a.csv: has no row"));
}

}  // namespace
}  // namespace cosight
