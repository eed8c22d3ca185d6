#include "shared/transport/robot_topic_source.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "shared/transport/robot_publisher.hpp"
#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

class RobotTopics : public testing::Test {
 protected:
  RobotTopics() { frame_ = example_.image(ImageEncoding::kJpeg, 40, 30); }

  /// Until all of the publisher's topics have a reader.
  static bool is_matched(const RobotPublisher& publisher) {
    return eventually([&] {
      for (const auto& [name, counters] : publisher.counters()) {
        if (counters.readers == 0) return false;
      }
      return true;
    });
  }

  ExampleSamples example_;
  ImageSample frame_;
  std::atomic<bool> stop_ = false;
  Participant robot_{loopback("robot")};
  Participant sensors_{loopback("sensors")};
};

TEST_F(RobotTopics, WhatTheRobotUsesItselfIsToTheLastBitWhatOthersReceive) {
  RobotTopicSource source(robot_, 0.0, stop_);
  RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
  ASSERT_TRUE(is_matched(publisher));
  for (int i = 0; i < 20; ++i) {
    const WheelOdometrySample sample = example_.wheel_odometry();
    publisher.publish(sample);
    const auto received = source.next();
    ASSERT_TRUE(received);
    EXPECT_EQ(std::get<WheelOdometrySample>(*received).yaw,
              std::get<WheelOdometrySample>(as_received(sample)).yaw);
  }
}

TEST_F(RobotTopics, EverySensorComesThrough) {
  RobotTopicSource source(robot_, 0.0, stop_);
  RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
  ASSERT_TRUE(is_matched(publisher));
  LaserScanSample rear = example_.scan(5);
  rear.laser = "laser_rear";
  const std::vector<Sample> sent = {frame_, example_.scan(133), rear, example_.imu(),
                                    example_.wheel_odometry()};
  for (const Sample& sample : sent) {
    publisher.publish(sample);
    const auto received = source.next();
    ASSERT_TRUE(received);
    ASSERT_EQ(received->index(), sample.index());
    std::visit(
        [&](const auto& expected) {
          using Expected = std::decay_t<decltype(expected)>;
          if constexpr (!std::is_same_v<Expected, AhrsSample>)
            expect_equal(std::get<Expected>(*received), expected);
        },
        sample);
  }
  EXPECT_EQ(source.counters(SampleKind::kLaserScan).delivered, 2U);
  EXPECT_EQ(source.counters().delivered, 5U);
}

TEST_F(RobotTopics, ThePublisherWaitsForAllOfTheRobotsReaders) {
  RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
  const InboxOf<ImageSample> frames(robot_, topics::kRobotImageCompressed);
  std::optional<InboxOf<WheelOdometrySample>> odometry;
  std::jthread late([&] {
    std::this_thread::sleep_for(50ms);
    odometry.emplace(robot_, topics::kRobotWheelOdometry);
  });
  EXPECT_TRUE(publisher.wait_for_robot(5000ms));
  const auto counters = publisher.counters();
  EXPECT_EQ(counters.back().first, "dds_robot_wheel_odometry");
  EXPECT_EQ(counters.back().second.readers, 1);
}

TEST_F(RobotTopics, ARobotNeedNotReadThemAll) {
  RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
  EXPECT_FALSE(publisher.wait_for_robot(50ms));
  const InboxOf<ImageSample> frames(robot_, topics::kRobotImageCompressed);
  EXPECT_TRUE(publisher.wait_for_robot(5000ms));
}

TEST_F(RobotTopics, TheStreamEndsWhenItsPublisherHasGone) {
  RobotTopicSource source(robot_, 0.2, stop_);
  std::optional<RobotPublisher> publisher(std::in_place, sensors_, ImageEncoding::kJpeg, false);
  ASSERT_TRUE(is_matched(*publisher));
  publisher->publish(frame_);
  ASSERT_TRUE(source.next());
  publisher.reset();
  EXPECT_FALSE(source.next());
}

TEST_F(RobotTopics, WithoutAFrameYetItWaitsForOne) {
  RobotTopicSource source(robot_, 0.05, stop_);
  std::jthread late([&] {
    std::this_thread::sleep_for(300ms);
    RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
    if (is_matched(publisher)) publisher.publish(frame_);
    publisher.wait_until_delivered(2000ms);
  });
  EXPECT_TRUE(source.next());
}

TEST_F(RobotTopics, StoppingEndsTheWait) {
  RobotTopicSource source(robot_, 0.0, stop_);
  std::jthread interrupt([&] {
    std::this_thread::sleep_for(100ms);
    stop_ = true;
  });
  EXPECT_FALSE(source.next());
}

TEST_F(RobotTopics, TheCameraIsToldToWhoComesLater) {
  EXPECT_FALSE(receive_robot_camera(robot_, 50ms, stop_));
  RobotPublisher publisher(sensors_, ImageEncoding::kJpeg, false);
  const CameraInfoSample info = example_.camera_info(Distortion::kRadtan);
  publisher.publish(info.camera, info.stamp);
  const auto camera = receive_robot_camera(robot_, 5000ms, stop_);
  ASSERT_TRUE(camera);
  EXPECT_EQ(camera->fx, info.camera.fx);
}

TEST_F(RobotTopics, RawFramesHaveATopicOfTheirOwn) {
  RobotTopicSource source(robot_, 0.0, stop_);
  RobotPublisher publisher(sensors_, ImageEncoding::kMono8, false);
  ASSERT_TRUE(is_matched(publisher));
  const ImageSample raw = example_.image(ImageEncoding::kMono8, 40, 30);
  publisher.publish(raw);
  const auto received = source.next();
  ASSERT_TRUE(received);
  expect_equal(std::get<ImageSample>(*received), raw);
}

}  // namespace
}  // namespace cosight::transport
