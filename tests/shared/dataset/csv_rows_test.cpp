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

TEST(ParseNumber, TakesOneFiniteNumberAndNothingElse) {
  EXPECT_EQ(parse_number("1.5e-3"), 1.5e-3);
  EXPECT_EQ(parse_number("+2"), 2.0);
  for (const char* text : {"", "nan", "inf", "-inf", "1,5", "1.5x", " 1", "1e999", "0x1"}) {
    EXPECT_EQ(parse_number(text), std::nullopt) << text;
  }
}

TEST(ParseStamp, SecondsKeepEveryNanosecondOfToday) {
  EXPECT_EQ(parse_stamp_s("1403715285.262143135"), 1403715285262143135);
  EXPECT_EQ(parse_stamp_s("1403715285.26"), 1403715285260000000);
  EXPECT_EQ(parse_stamp_s("1.037359e-01"), 103735900);
  EXPECT_EQ(parse_stamp_s("-0.5"), -500000000);
  EXPECT_EQ(parse_stamp_s("7"), 7000000000);
  for (const char* text : {"nan", "", ".", "1.", "1.2.3", "1.2x", "99999999999.0", "1e30"}) {
    const auto stamp = parse_stamp_s(text);
    EXPECT_TRUE(!stamp || std::string(text) == "1.") << text;
  }
}

TEST(ParseStamp, NanosecondsAreWholeNumbers) {
  EXPECT_EQ(parse_stamp_ns("1403715285262142976"), 1403715285262142976);
  for (const char* text : {"1.5", "1e18", "nan", "", "99999999999999999999"}) {
    EXPECT_EQ(parse_stamp_ns(text), std::nullopt) << text;
  }
}

}  // namespace
}  // namespace cosight
