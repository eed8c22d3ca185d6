#include "wearable_agent/run_report.hpp"

#include <gmock/gmock.h>

#include "shared/config/config.hpp"

namespace cosight::wearable {
namespace {

RunReport example() {
  RunReport report;
  report.sent = {.frames = 100, .orientations = 1000, .bytes = 5'000'000, .not_taken = 0};
  report.duration = 10.0;
  report.cpu_seconds = 0.5;
  return report;
}

TEST(RunReportTest, TheSummaryIsYamlWithUnitsInItsNames) {
  RunReport report = example();
  report.frames.unreadable = 3;
  const ConfigFile file = ConfigFile::parse(summary_yaml(report), "summary.yaml");
  EXPECT_EQ(file.root().integer("frames_sent", 0), 100);
  EXPECT_DOUBLE_EQ(file.root().number("frames_per_s", 0), 10.0);
  EXPECT_DOUBLE_EQ(file.root().number("bytes_per_s", 0), 500'000.0);
  EXPECT_DOUBLE_EQ(file.root().number("cpu_percent", 0), 5.0);
  EXPECT_EQ(file.root().section("input_frames").integer("unreadable", 0), 3);
}

TEST(RunReportTest, ARunOfNoTimeHasNoRates) {
  EXPECT_THAT(summary_yaml({}), testing::HasSubstr("bytes_per_s: 0\n"));
}

TEST(RunReportTest, OnlyWhatIsMissingFromTheStreamIsALoss) {
  RunReport report = example();
  report.frames.gaps = 5;
  EXPECT_FALSE(report.lost_data());
  report.frames.unreadable = 1;
  EXPECT_TRUE(report.lost_data());
  report = example();
  report.orientations.stamp_went_back = 1;
  EXPECT_TRUE(report.lost_data());
  report = example();
  report.sent.not_taken = 1;
  EXPECT_TRUE(report.lost_data());
}

TEST(RunReportTest, TheStatusLineFitsATerminal) {
  EXPECT_EQ(status_text(example(), 1),
            "10.0 s  100 frames (10.0/s)  1000 orientations  0.50 MB/s  1 readers  lost 0");
}

TEST(RunReportTest, ASummaryThatCanNotBeWrittenIsNamed) {
  EXPECT_THROW(write_summary("/no/such/folder/s.yaml", example()), std::runtime_error);
}

}  // namespace
}  // namespace cosight::wearable
