#include "tools/run_agreement.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <string>

#include "shared/evaluation/evaluation_error.hpp"
#include "tests/tools/scratch_folder.hpp"

namespace cosight {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

class RunAgreement : public testing::Test {
 protected:
  std::filesystem::path run(const std::string& name) const { return folder_.path() / name; }

  /// Ten frames; `y` of the sixth, and its worn frame.
  void write_run(const std::string& name, const std::string& y, const std::string& worn_delay_ms,
                 int worn_late) const {
    std::filesystem::create_directories(run(name));
    std::ofstream trajectory(run(name) / "trajectory.tum");
    std::ofstream frames(run(name) / "frames.csv");
    frames << "stamp_ns,worn_delay_ms\n";
    for (int i = 0; i < 10; ++i) {
      trajectory << i << ".0 1.5 " << (i == 5 ? y : "0.25") << " 0 0 0 0 1\n";
      frames << i * 1'000'000'000LL << ',' << (i == 5 ? worn_delay_ms : "0") << '\n';
    }
    std::ofstream(run(name) / "map.ply") << "same";
    std::ofstream(run(name) / "map.pcd") << "same";
    std::ofstream(run(name) / "summary.yaml") << "inbox:\n  paired: 9\n  worn_late: " << worn_late << '\n';
  }

  std::vector<double> values(const std::string& name) const {
    std::vector<double> values;
    for (const Metric& metric : agreement(run(name), run("live")))
      values.push_back(metric.value.value_or(-1.0));
    return values;
  }

  ScratchFolder folder_{"agreement"};
};

TEST_F(RunAgreement, EqualRunsAgreeInAllThatTheyWrote) {
  write_run("live", "0.25", "0", 0);
  write_run("offline", "0.25", "0", 0);
  EXPECT_THAT(values("offline"), ElementsAre(10, 10, -1, 0, 0, 0, 0, 3));
  EXPECT_TRUE(differing_counters({run("live"), run("offline")}).empty());
}

TEST_F(RunAgreement, TellsWhichFrameDiffersFirstByHowMuchAndWhatWasCounted) {
  write_run("live", "0.25", "0", 0);
  write_run("late", "0.55", "", 3);
  EXPECT_THAT(values("late"), ElementsAre(10, 9, 5, 1, DoubleNear(0.3 / std::sqrt(10.0), 1e-12),
                                          DoubleNear(0.3, 1e-12), 0, 2));
  const auto counters = differing_counters({run("live"), run("late")});
  ASSERT_EQ(counters.size(), 1U);
  EXPECT_EQ(counters[0].name, "inbox.worn_late");
  EXPECT_THAT(counters[0].counts, ElementsAre(0, 3));
}

TEST_F(RunAgreement, AFolderWithoutARunIsAnErrorThatNamesIt) {
  write_run("live", "0.25", "0", 0);
  EXPECT_THROW(agreement(run("nothing"), run("live")), EvaluationError);
}

}  // namespace
}  // namespace cosight
