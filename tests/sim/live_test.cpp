#include "sim/live.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "shared/transport/robot_topic_source.hpp"
#include "sim/rendered_frames.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::sim {
namespace {

/// A second in a small room, very small pictures.
Scenario short_walk() {
  Scenario scenario;
  scenario.plan.outlines.push_back({{{-1, -2}, {5, -2}, {5, 2}, {-1, 2}}, Material::kPlaster, 1.0});
  scenario.plan.texel = 0.02;
  scenario.path.waypoints = {{0, 0}, {2, 0}};
  scenario.duration = 1.0;
  for (CameraPlan* camera : {&scenario.robot_camera, &scenario.wearer_camera}) {
    camera->lens = {.fx = 50, .fy = 50, .cx = 39.5, .cy = 29.5, .width = 80, .height = 60};
  }
  return scenario;
}

class LiveRun : public testing::Test {
 protected:
  Scenario scenario_ = short_walk();
  SimulatedRun run_{scenario_, 1};
};

TEST_F(LiveRun, FramesRenderedAheadAreThoseOfTheRunInTheirOrder) {
  RenderedFrames source(run_.robot(), 3);
  Film film = run_.robot().film();
  for (std::size_t frame = 0; frame < run_.robot().ticks.size(); ++frame) {
    const auto sample = source.next();
    ASSERT_TRUE(sample);
    const ImageSample expected = run_.robot().sample(film, frame);
    EXPECT_EQ(std::get<ImageSample>(*sample).stamp, expected.stamp);
    EXPECT_EQ(std::get<ImageSample>(*sample).sequence, frame);
    EXPECT_EQ(std::get<ImageSample>(*sample).bytes, expected.bytes);
  }
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.counters().delivered, run_.robot().ticks.size());
}

TEST_F(LiveRun, NobodyNeedsToTakeAllFrames) {
  scenario_.duration = 60.0;
  const SimulatedRun longer(scenario_, 1);
  RenderedFrames source(longer.robot(), 2);
  EXPECT_TRUE(source.next());  // and the destructor comes back
}

TEST_F(LiveRun, EverySensorOfBothAgentsIsHeardOnItsTopic) {
  const transport::Participant there(transport::loopback("listener"));
  transport::InboxOf<AhrsSample> ahrs(there, transport::topics::kWearableImu);
  transport::InboxOf<ImageSample> worn(there, transport::topics::kWearableImageCompressed);
  transport::InboxOf<CameraInfoSample> worn_camera(there, transport::topics::kWearableCameraInfo);
  transport::InboxOf<HeartbeatSample> heartbeat(there, transport::topics::kWearableHeartbeat);
  transport::InboxOf<WearerPoseSample> poses(there, transport::topics::kRobotWearerPose);
  std::atomic<bool> stop = false;
  transport::RobotTopicSource robot(there, 0.3, stop);
  LiveOptions options;
  options.dds = transport::loopback("sim");
  options.tracks_wearer = true;
  std::jthread simulator([&] {
    const LiveReport report = play_live(run_, options, stop);
    EXPECT_TRUE(report.had_readers);
    EXPECT_EQ(report.robot.frames, run_.robot().ticks.size());
  });
  while (robot.next()) {
  }
  EXPECT_EQ(robot.counters(SampleKind::kImage).delivered, run_.robot().ticks.size());
  EXPECT_GT(robot.counters(SampleKind::kLaserScan).delivered, 40U);
  EXPECT_GT(robot.counters(SampleKind::kImu).delivered, 150U);
  EXPECT_GT(robot.counters(SampleKind::kWheelOdometry).delivered, 15U);
  EXPECT_TRUE(worn.wait_for(run_.wearer().ticks.size()));
  EXPECT_TRUE(ahrs.wait_for(80));
  EXPECT_TRUE(poses.wait_for(run_.robot().ticks.size() - 1));
  EXPECT_TRUE(worn_camera.wait_for(1));
  EXPECT_TRUE(heartbeat.wait_for(1));
}

TEST_F(LiveRun, StoppingEndsAWaitForReaders) {
  std::atomic<bool> stop = false;
  std::jthread interrupt([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds{100});
    stop = true;
  });
  LiveOptions options;
  options.dds = transport::loopback("sim");
  options.wait = 3600.0;
  const LiveReport report = play_live(run_, options, stop);
  EXPECT_FALSE(report.had_readers);
  EXPECT_EQ(report.robot.frames, 0U);
}

}  // namespace
}  // namespace cosight::sim
