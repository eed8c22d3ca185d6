#include "robot_agent/options.hpp"

#include "tests/shared/config/described_defaults.hpp"

namespace cosight::robot {
namespace {

TEST(RobotOptions, ConfigRobotYamlHasEveryKeyWithItsDefault) {
  // Paths are relative to the file, and its folder is not the working folder.
  expect_describes_defaults("robot.yaml", read_robot_options, "input.dataset=folder", {"run_dir"});
}

TEST(RobotOptions, WhatTheYawOffsetLeavesOpenIsSlamsToFind) {
  const ConfigFile file = ConfigFile::parse(
      "input: {dataset: folder}\ninbox: {ahrs_yaw_offset_deg: 90, ahrs_yaw_offset_sigma_deg: 9}",
      "test.yaml");
  const RobotOptions options = read_robot_options(file.root());
  EXPECT_DOUBLE_EQ(options.inbox.mounting.yaw_offset, M_PI / 2);
  EXPECT_DOUBLE_EQ(options.slam.yaw_offset.prior.angle, 0.0);
  EXPECT_DOUBLE_EQ(options.slam.yaw_offset.prior.sigma, M_PI / 20);
}

}  // namespace
}  // namespace cosight::robot
