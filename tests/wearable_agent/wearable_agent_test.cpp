#include "wearable_agent/wearable_agent.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "tests/shared/transport/inbox_of.hpp"
#include "tests/wearable_agent/small_dataset.hpp"

namespace cosight::wearable {
namespace {

using testing::HasSubstr;
using transport::eventually;
using transport::InboxOf;
using transport::Participant;
using transport::TransportError;
namespace topics = transport::topics;

class WearableAgentTest : public testing::Test {
 protected:
  WearableOptions options() const {
    WearableOptions options;
    options.input.dataset = dataset_.folder();
    options.dds = transport::loopback("wearable");
    options.listen_for_twin = 0.0;
    options.wait_for_robot = 5.0;
    return options;
  }

  SmallDataset dataset_;
  std::atomic<bool> stop_ = false;
  Participant robot_{transport::loopback("robot")};
};

TEST_F(WearableAgentTest, EverythingArrivesUnchanged) {
  InboxOf<ImageSample> frames(robot_, topics::kWearableImageCompressed);
  InboxOf<AhrsSample> orientations(robot_, topics::kWearableImu);
  InboxOf<CameraInfoSample> calibration(robot_, topics::kWearableCameraInfo);
  WearableAgent agent(options(), stop_);
  ASSERT_TRUE(orientations.subscriber.wait_for_writers(1, std::chrono::seconds(5)));
  const RunReport report = agent.run();
  ASSERT_TRUE(frames.wait_for(SmallDataset::kFrames));
  ASSERT_TRUE(orientations.wait_for(SmallDataset::kOrientations));
  ASSERT_TRUE(calibration.wait_for(1));
  std::vector<std::uint8_t> on_disk;
  ASSERT_TRUE(read_bytes(dataset_.frame(3), on_disk));
  EXPECT_EQ(frames.received()[3].sample.bytes, on_disk);
  EXPECT_EQ(frames.received()[3].sample.stamp, 1'060'000'000);
  EXPECT_EQ(calibration.received()[0].sample.camera.width, 64);
  EXPECT_EQ(report.sent.frames, 10U);
  EXPECT_EQ(report.sent.orientations, 40U);
  EXPECT_FALSE(report.lost_data());
  EXPECT_NEAR(report.duration, 0.195, 0.19) << "paced by the stamps";
}

TEST_F(WearableAgentTest, RawFramesGoToTheirOwnTopic) {
  InboxOf<ImageSample> frames(robot_, topics::kWearableImage);
  WearableOptions raw = options();
  raw.input.output.encoding = ImageEncoding::kMono8;
  WearableAgent agent(raw, stop_);
  agent.run();
  ASSERT_TRUE(frames.wait_for(SmallDataset::kFrames));
  const ImageSample last = frames.received().back().sample;
  EXPECT_EQ(last.width, 64);
  EXPECT_NEAR(last.bytes.at(100), 180, 2);
}

TEST_F(WearableAgentTest, AFrameThatCanNotBeReadIsCountedAsLost) {
  std::filesystem::resize_file(dataset_.frame(4), 100);
  InboxOf<ImageSample> frames(robot_, topics::kWearableImageCompressed);
  WearableAgent agent(options(), stop_);
  const RunReport report = agent.run();
  EXPECT_EQ(report.sent.frames, 9U);
  EXPECT_EQ(report.frames.unreadable, 1U);
  EXPECT_TRUE(report.lost_data());
}

TEST_F(WearableAgentTest, ARobotThatNeverComesIsAClearError) {
  WearableOptions alone = options();
  alone.wait_for_robot = 0.2;
  WearableAgent agent(alone, stop_);
  try {
    agent.run();
    FAIL() << "ran without a robot";
  } catch (const TransportError& error) {
    EXPECT_THAT(error.what(), HasSubstr("no robot reads frames on domain"));
  }
}

TEST_F(WearableAgentTest, WithoutWaitingItStreamsToNobody) {
  WearableOptions alone = options();
  alone.wait_for_robot = 0.0;
  alone.replay.rate = 0.0;
  WearableAgent agent(alone, stop_);
  EXPECT_EQ(agent.run().sent.frames, 10U);
}

TEST_F(WearableAgentTest, StopEndsALoop) {
  InboxOf<ImageSample> frames(robot_, topics::kWearableImageCompressed);
  WearableOptions loop = options();
  loop.replay.loop = true;
  WearableAgent agent(loop, stop_);
  std::jthread watch([&] {
    frames.wait_for(SmallDataset::kFrames + 3);
    stop_ = true;
  });
  const RunReport report = agent.run();
  EXPECT_GE(report.sent.frames, 13U);
  EXPECT_GT(frames.received()[12].sample.stamp, frames.received()[9].sample.stamp);
}

TEST_F(WearableAgentTest, ASecondWearableWithTheSameIdRefusesToStart) {
  InboxOf<ImageSample> frames(robot_, topics::kWearableImageCompressed);
  InboxOf<HeartbeatSample> heartbeats(robot_, topics::kWearableHeartbeat);
  WearableOptions loop = options();
  loop.replay.loop = true;
  WearableAgent first(loop, stop_);
  RunReport report;
  std::jthread running([&] { report = first.run(); });
  ASSERT_TRUE(heartbeats.wait_for(8));
  WearableOptions twin = options();
  twin.listen_for_twin = 5.0;
  WearableAgent second(twin, stop_);
  try {
    second.run();
    FAIL() << "a second wearable ran";
  } catch (const TransportError& error) {
    EXPECT_THAT(error.what(), HasSubstr("a wearable with the id 'wearer' is already running"));
  }
  const std::uint64_t frames_so_far = frames.received().size();
  EXPECT_TRUE(eventually([&] { return frames.received().size() > frames_so_far; })) << "the first goes on";
  stop_ = true;
}

}  // namespace
}  // namespace cosight::wearable
