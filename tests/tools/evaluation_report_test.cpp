#include "tools/evaluation_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "shared/evaluation/evaluation_error.hpp"
#include "tests/tools/scratch_folder.hpp"
#include "tools/trajectory_plot.hpp"

namespace cosight {
namespace {

using testing::HasSubstr;

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(EvaluationReport, SaysNotAvailableWhereAMetricIsUndefined) {
  const ScratchFolder folder("report");
  const std::vector<Metric> metrics{{"ate_m", 0.25}, {"tau", std::nullopt}};
  EXPECT_THAT(metrics_table(metrics), HasSubstr("n/a"));
  write_metrics_json(folder.path() / "m.json", metrics);
  EXPECT_EQ(content_of(folder.path() / "m.json"), "{\n  \"ate_m\": 0.25,\n  \"tau\": null\n}\n");
}

TEST(EvaluationReport, IsReadBackAsItWasWritten) {
  const ScratchFolder folder("report");
  write_metrics_json(folder.path() / "m.json", {{"ate_m", 0.25}, {"tau", std::nullopt}});
  const std::vector<Metric> metrics = read_metrics_json(folder.path() / "m.json");
  ASSERT_EQ(metrics.size(), 2U);
  EXPECT_EQ(metrics[0].name, "ate_m");
  EXPECT_EQ(metrics[0].value, 0.25);
  EXPECT_FALSE(metrics[1].value);
  EXPECT_THROW(read_metrics_json(folder.path() / "none.json"), EvaluationError);
}

TEST(EvaluationReport, ThatCannotBeWrittenSaysSo) {
  EXPECT_THROW(write_metrics_json("/nowhere/m.json", {}), EvaluationError);
  EXPECT_THROW(write_errors_csv("/nowhere/e.csv", {}), EvaluationError);
}

TEST(TrajectoryPlot, IsAPngEvenWithQuotesInItsName) {
  const ScratchFolder folder("it's a plot");
  Evaluation evaluation;
  for (int i = 0; i < 3; ++i) {
    PosePair pair;
    pair.stamp = i * kNanosecondsPerSecond;
    pair.T_WC_truth.p.x() = i;
    evaluation.pairs.push_back(pair);
    evaluation.position_errors.push_back(i);
    evaluation.rotation_errors.push_back(0.0);
  }
  const std::filesystem::path csv = folder.path() / "errors.csv";
  write_errors_csv(csv, evaluation);
  if (!plot_trajectories(folder.path() / "t.png", "the wearer's view", {{"mono_1", csv}})) {
    GTEST_SKIP() << "gnuplot is not installed";
  }
  EXPECT_THAT(content_of(folder.path() / "t.png"), HasSubstr("PNG"));
}

}  // namespace
}  // namespace cosight
