#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "shared/evaluation/evaluation_error.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "shared/evaluation/trajectory_writer.hpp"
#include "tests/shared/evaluation/made_trajectory.hpp"
#include "tests/shared/evaluation/text_file.hpp"

namespace cosight {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

void expect_same(const Trajectory& read, const Trajectory& written, double stamp_tolerance_ns) {
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(static_cast<double>(read[i].stamp), static_cast<double>(written[i].stamp),
                stamp_tolerance_ns);
    EXPECT_LT((read[i].T_WC.p - written[i].T_WC.p).norm(), 1e-8);
    EXPECT_LT(read[i].T_WC.q.angularDistance(written[i].T_WC.q), 1e-7);
  }
}

class TrajectoryFileOfFormat : public testing::TestWithParam<TrajectoryFormat> {};

TEST_P(TrajectoryFileOfFormat, IsReadAsItWasWritten) {
  const Trajectory written = spiral(40);
  const TextFile file("round_trip_" + std::to_string(static_cast<int>(GetParam())), "");
  const TextFile times("times_" + std::to_string(static_cast<int>(GetParam())), [] {
    std::string text;
    for (int i = 0; i < 40; ++i)
      text += std::to_string(0.1 * i) + "\n";
    return text;
  }());
  write_trajectory(file.path(), written, GetParam());
  expect_same(read_trajectory(file.path(), times.path()), written, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Every, TrajectoryFileOfFormat,
                         testing::Values(TrajectoryFormat::kTum, TrajectoryFormat::kEuroc,
                                         TrajectoryFormat::kKitti));

TEST(TrajectoryFile, ColumnsOfTumAreXyzwAndOfEurocWxyz) {
  const TextFile tum("columns_tum", "# comment\n1.5 1 2 3 0.5 -0.5 0.5 0.5\n");
  const TextFile euroc("columns_euroc", "#timestamp,...\n1500000000,1,2,3,0.5,0.5,-0.5,0.5,9,9,9\n");
  for (const auto* file : {&tum, &euroc}) {
    const Trajectory trajectory = read_trajectory(file->path());
    ASSERT_EQ(trajectory.size(), 1U);
    EXPECT_EQ(trajectory[0].stamp, 1'500'000'000);
    EXPECT_EQ(trajectory[0].T_WC.p, Eigen::Vector3d(1, 2, 3));
    EXPECT_LT(trajectory[0].T_WC.q.angularDistance(Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5)), 1e-12);
  }
}

TEST(TrajectoryFile, KittiRowsWithoutTimesAreOneSecondApart) {
  const TextFile file("kitti_no_times", "1 0 0 1 0 1 0 2 0 0 1 3\n0 -1 0 1 1 0 0 2 0 0 1 4\n");
  const Trajectory trajectory = read_trajectory(file.path());
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[1].stamp, kNanosecondsPerSecond);
  EXPECT_EQ(trajectory[1].T_WC.p, Eigen::Vector3d(1, 2, 4));
  EXPECT_LT((trajectory[1].T_WC.q * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

struct BadFile {
  const char* name;
  const char* content;
  const char* complaint;
};

class BadTrajectoryFile : public testing::TestWithParam<BadFile> {};

TEST_P(BadTrajectoryFile, IsRefusedWithFileAndLine) {
  const TextFile file(GetParam().name, GetParam().content);
  EXPECT_THAT([&] { read_trajectory(file.path()); },
              ThrowsMessage<EvaluationError>(HasSubstr(file.path().string() + GetParam().complaint)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadTrajectoryFile,
    testing::Values(
        BadFile{"nan", "# c\n1 0 0 nan 0 0 0 1\n", ":2: column 4, 'nan', is not a finite number"},
        BadFile{"columns", "1 0 0 0 0 0 1\n", ":1: has 7 columns"},
        BadFile{"unit", "1 0 0 0 1 0 0 1\n", ":1: the quaternion's length"},
        BadFile{"back", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n", ":2: the stamp 1.000000000 s is not later"},
        BadFile{"twice", "2 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n", ":2: the stamp"},
        BadFile{"empty", "# nothing\n", ": holds no pose"},
        BadFile{"no_rotation", "2 0 0 1 0 1 0 2 0 0 1 3\n", ":1: the left 3x3 block is not a rotation"},
        BadFile{"mirror", "1 0 0 1 0 1 0 2 0 0 -1 3\n", ":1: the left 3x3 block is not a rotation"},
        BadFile{"euroc_short", "1,2,3\n", ":1: has 3 columns"}),
    [](const auto& test) { return test.param.name; });

TEST(TrajectoryFile, AMissingOneIsNamed) {
  EXPECT_THAT([] { read_trajectory("/nowhere/run.tum"); },
              ThrowsMessage<EvaluationError>(HasSubstr("/nowhere/run.tum: cannot be opened")));
}

TEST(TrajectoryFile, AnUnwritableOneIsNamed) {
  EXPECT_THAT(
      [] { write_trajectory(std::filesystem::path("/nowhere/run.tum"), spiral(2), TrajectoryFormat::kTum); },
      ThrowsMessage<EvaluationError>(HasSubstr("/nowhere/run.tum: cannot be written")));
}

}  // namespace
}  // namespace cosight
