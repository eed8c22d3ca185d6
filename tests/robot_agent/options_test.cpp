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

VinsHelp help_of(const std::string& vins) {
  return read_robot_options(ConfigFile::parse("input: {dataset: folder}\n" + vins, "test.yaml").root())
      .vins_help;
}

TEST(RobotOptions, SlamAndVinsHelpEachOtherWhereBothRun) {
  EXPECT_TRUE(help_of("vins: {enable: true}").guides_slam);
  EXPECT_TRUE(help_of("vins: {enable: true}").takes_depths);
  EXPECT_FALSE(help_of("vins: {enable: true, guide_slam: false}").guides_slam);
  EXPECT_FALSE(help_of("vins: {enable: true, take_depths: false}").takes_depths);
}

TEST(RobotOptions, NobodyHelpsWhereOneRunsAlone) {
  EXPECT_FALSE(help_of("").takes_depths);
  EXPECT_FALSE(help_of("only: vins").takes_depths);
  EXPECT_FALSE(help_of("only: vins").guides_slam);
}

}  // namespace
}  // namespace cosight::robot
