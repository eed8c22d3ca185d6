#include "robot_agent/wearer_options.hpp"

#include <gmock/gmock.h>

namespace cosight::robot {
namespace {

using testing::HasSubstr;

WearerSection read(const std::string& yaml) {
  const ConfigFile file = ConfigFile::parse(yaml, "test.yaml");
  WearerSection section = read_wearer_section(file.root().section("wearer"));
  file.refuse_unknown_keys();
  return section;
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(WearerSection, AnEmptyOneIsTheDefault) {
  const WearerSection section = read("");
  EXPECT_EQ(section.pose_from, WearerPoseFrom::kAuto);
  EXPECT_DOUBLE_EQ(section.tracking.head.height, wearer::HeadOptions{}.height);
  EXPECT_FALSE(section.tracking.start.p_B);
  EXPECT_TRUE(section.tracking.scene.own_body.isApprox(wearer::SceneOptions{}.own_body));
}

TEST(WearerSection, WhatIsGivenIsRead) {
  const WearerSection section = read(
      "wearer: {pose_from: laser, head_height_m: 1.8, start_at_m: [1.5, -0.2], own_body_m: [-1, -1, 1, 1]}");
  EXPECT_EQ(section.pose_from, WearerPoseFrom::kLaser);
  EXPECT_DOUBLE_EQ(section.tracking.head.height, 1.8);
  EXPECT_EQ(section.tracking.start.p_B, Eigen::Vector2d(1.5, -0.2));
  EXPECT_EQ(section.tracking.scene.own_body.max(), Eigen::Vector2d(1, 1));
}

TEST(WearerSection, WhatCannotBeIsAnErrorWithItsLine) {
  EXPECT_THAT(error_of([] { read("wearer: {start_at_m: [1]}"); }),
              HasSubstr("wearer.start_at_m: has to be [x, y]"));
  EXPECT_THAT(error_of([] { read("wearer: {own_body_m: [1, 0, 0, 1]}"); }), HasSubstr("wearer.own_body_m"));
  EXPECT_THAT(error_of([] { read("wearer: {pose_from: radar}"); }),
              HasSubstr("is none of auto, tracker, laser"));
}

TEST(WearerSection, LasersAndCameraAreWhereTheInputSays) {
  AgentInput input;
  EXPECT_THAT(error_of([&] { with_mountings({}, input); }), HasSubstr("give input.lasers"));
  input.lasers.push_back({.laser = "laser_rear", .T_BL = {Eigen::Quaterniond::Identity(), {-1, 0, 0.5}}});
  EXPECT_THAT(error_of([&] { with_mountings({}, input); }), HasSubstr("add T_BC"));
  input.T_BS = Pose{Eigen::Quaterniond::Identity(), {0.3, 0, 1}};
  const wearer::WearerOptions options = with_mountings({}, input);
  ASSERT_EQ(options.lasers.size(), 1U);
  EXPECT_EQ(options.lasers.at("laser_rear").T_BL.p, Eigen::Vector3d(-1, 0, 0.5));
  EXPECT_EQ(options.head.T_BS.p, Eigen::Vector3d(0.3, 0, 1));
}

}  // namespace
}  // namespace cosight::robot
