#include "tools/prepare/dataset_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "shared/evaluation/csv_table.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/tools/scratch_folder.hpp"
#include "tools/prepare/prepare_error.hpp"

namespace cosight {
namespace {

/// Two robot frames, the second with a worn frame 1 m to the left, turned by 0.2 rad about its own y.
RealSequence two_frames() {
  RealSequence sequence;
  const Pose T_WS{forward_looking_camera(), {1, 2, 3}};
  const Pose T_WF{T_WS.q * quaternion_exp({0, 0.2, 0}), T_WS.p + Eigen::Vector3d(0, 1, 0)};
  sequence.robot_images = {{100, "/images/0.jpg", T_WS}, {200, "/images/1.jpg", T_WS}};
  sequence.wearer_images = {{200, "/images/w.jpg", T_WF}};
  sequence.known_points = {{{1, 2, 3}, Eigen::Vector2d(10, 20)}, {{4, 5, 6}, std::nullopt}};
  return sequence;
}

DatasetNoise tiny_noise() {
  DatasetNoise noise;
  noise.wearer_pose = {Eigen::Vector3d::Constant(1e-9), Eigen::Vector3d::Constant(1e-9)};
  noise.ahrs_sigma.setConstant(1e-9);
  return noise;
}

TEST(DatasetFolder, HoldsThePoseOfTheWornCameraInTheRobotsCamera) {
  const ScratchFolder folder("poses");
  write_dataset_folder(folder.path(), two_frames(), tiny_noise());
  const CsvTable poses = CsvTable::read(folder.path() / "robot" / "wearer_pose.csv");
  ASSERT_EQ(poses.rows(), 1U);
  EXPECT_EQ(poses.stamp(0, "stamp_ns"), 200);
  EXPECT_NEAR(poses.number(0, "px"), -1.0, 1e-6) << "left of the robot's camera is -x of its optical frame";
  EXPECT_NEAR(poses.number(0, "py"), 0.0, 1e-6);
  EXPECT_NEAR(poses.number(0, "pz"), 0.0, 1e-6);
  EXPECT_NEAR(poses.number(0, "qy"), std::sin(0.1), 1e-6);
  EXPECT_NEAR(poses.number(0, "qw"), std::cos(0.1), 1e-6);
  EXPECT_NEAR(poses.number(0, "sigma_rz"), 1e-9, 1e-12);
}

TEST(DatasetFolder, HoldsTheHeadsOrientationAsAHeadHasIt) {
  const ScratchFolder folder("ahrs");
  write_dataset_folder(folder.path(), two_frames(), tiny_noise());
  const CsvTable ahrs = CsvTable::read(folder.path() / "wearer" / "ahrs.csv");
  // A turn about the optical y, which points down, is one to the right: about -z of the head.
  EXPECT_NEAR(ahrs.number(0, "qz"), -std::sin(0.1), 1e-6);
  EXPECT_NEAR(ahrs.number(0, "qx"), 0.0, 1e-6);
  EXPECT_NEAR(ahrs.number(0, "qy"), 0.0, 1e-6);
}

TEST(DatasetFolder, HoldsImagesTruthAndKnownPoints) {
  const ScratchFolder folder("rest");
  write_dataset_folder(folder.path(), two_frames(), tiny_noise());
  EXPECT_EQ(CsvTable::read(folder.path() / "robot" / "cam0.csv").text(1, "file"), "/images/1.jpg");
  EXPECT_EQ(CsvTable::read(folder.path() / "wearer" / "cam0.csv").rows(), 1U);
  EXPECT_EQ(read_trajectory(folder.path() / "truth" / "robot_cam0.tum").size(), 2U);
  EXPECT_EQ(read_trajectory(folder.path() / "truth" / "wearer_cam0.tum").size(), 1U);
  const CsvTable points = CsvTable::read(folder.path() / "robot" / "known_points.csv");
  EXPECT_EQ(points.number(0, "v"), 20.0);
  EXPECT_EQ(points.text(1, "u"), "");
}

TEST(DatasetFolder, WithoutAWearerHasNoWearersFiles) {
  const ScratchFolder folder("alone");
  RealSequence sequence = two_frames();
  sequence.wearer_images.clear();
  write_dataset_folder(folder.path(), sequence, tiny_noise());
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "wearer"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "robot" / "wearer_pose.csv"));
}

TEST(DatasetFolder, RefusesAWornFrameWithoutARobotPose) {
  const ScratchFolder folder("no_pose");
  RealSequence sequence = two_frames();
  sequence.wearer_images[0].stamp = 150;
  EXPECT_THROW(write_dataset_folder(folder.path(), sequence, tiny_noise()), PrepareError);
}

}  // namespace
}  // namespace cosight
