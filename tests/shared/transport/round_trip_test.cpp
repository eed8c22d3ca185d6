#include <gtest/gtest.h>

#include "shared/transport/publisher.hpp"
#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

/// Two participants, as in two processes: samples go through the sockets of the loopback.
class RoundTrip : public ::testing::Test {
 protected:
  template <class Sample>
  void travels_unchanged(const Topic<Sample>& topic, const Sample& sample) {
    InboxOf<Sample> inbox(there, topic);
    Publisher<Sample> publisher(here, topic);
    ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
    ASSERT_TRUE(publisher.publish(sample));
    ASSERT_TRUE(inbox.wait_for(1));
    expect_equal(inbox.received().front().sample, sample);
    EXPECT_EQ(publisher.counters().sent, 1U);
    EXPECT_TRUE(eventually([&] { return inbox.subscriber.counters().received == 1; }));
    EXPECT_EQ(inbox.subscriber.counters().invalid, 0U);
  }

  Participant here{loopback("here")};
  Participant there{loopback("there")};
  ExampleSamples example;
};

TEST_F(RoundTrip, CompressedImage) {
  travels_unchanged(topics::kWearableImageCompressed, example.image(ImageEncoding::kJpeg, 300, 200));
  travels_unchanged(topics::kRobotImageCompressed, example.image(ImageEncoding::kPng, 20, 10));
}
TEST_F(RoundTrip, RawImage) {
  travels_unchanged(topics::kWearableImage, example.image(ImageEncoding::kMono8, 752, 480));
}
TEST_F(RoundTrip, CameraInfo) {
  travels_unchanged(topics::kWearableCameraInfo, example.camera_info(Distortion::kRadtan));
  travels_unchanged(topics::kRobotCameraInfo, example.camera_info(Distortion::kEquidistant));
}
TEST_F(RoundTrip, Imu) {
  travels_unchanged(topics::kWearableImu, example.ahrs());
}
TEST_F(RoundTrip, WearerPose) {
  travels_unchanged(topics::kRobotWearerPose, example.wearer_pose(true));
}
TEST_F(RoundTrip, Odometry) {
  travels_unchanged(topics::kRobotOdometry, example.odometry());
}
TEST_F(RoundTrip, Map) {
  travels_unchanged(topics::kRobotMap, example.cloud(5000));
}
TEST_F(RoundTrip, Overlap) {
  travels_unchanged(topics::kRobotOverlap, example.overlap());
}
TEST_F(RoundTrip, Diagnostics) {
  travels_unchanged(topics::kRobotDiagnostics, example.diagnostic());
}
TEST_F(RoundTrip, Heartbeat) {
  travels_unchanged(topics::kWearableHeartbeat, example.heartbeat());
  travels_unchanged(topics::kRobotHeartbeat, example.heartbeat());
}

TEST_F(RoundTrip, FramesAreNumberedByTheirWriterWithoutAGap) {
  InboxOf<ImageSample> inbox(there, topics::kWearableImage);
  Publisher<ImageSample> publisher(here, topics::kWearableImage);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  const ImageSample frame = example.image(ImageEncoding::kMono8, 752, 480);
  constexpr std::size_t kFrames = 60;
  for (std::size_t i = 0; i < kFrames; ++i) {
    ASSERT_TRUE(publisher.publish(frame));
    ASSERT_TRUE(publisher.wait_until_delivered(2000ms));
  }
  ASSERT_TRUE(inbox.wait_for(kFrames));
  const auto received = inbox.received();
  for (std::size_t i = 0; i < kFrames; ++i) {
    EXPECT_EQ(received[i].sample.sequence, i + 1);
    EXPECT_EQ(received[i].reception.writer_id, received[0].reception.writer_id);
    EXPECT_GT(received[i].reception.stamp, 0);
  }
  EXPECT_EQ(inbox.subscriber.counters().lost, 0U);
}

TEST_F(RoundTrip, LateReaderGetsTheCalibrationButNoOldFrames) {
  Publisher<CameraInfoSample> calibration(here, topics::kWearableCameraInfo);
  Publisher<ImageSample> frames(here, topics::kWearableImageCompressed);
  ASSERT_TRUE(calibration.publish(example.camera_info(Distortion::kRadtan)));
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(frames.publish(example.image(ImageEncoding::kJpeg, 100, 100)));

  InboxOf<ImageSample> late_frames(there, topics::kWearableImageCompressed);
  InboxOf<CameraInfoSample> late_calibration(there, topics::kWearableCameraInfo);
  ASSERT_TRUE(frames.wait_for_readers(1, 5000ms));
  EXPECT_TRUE(late_calibration.wait_for(1));
  ASSERT_TRUE(eventually([&] { return late_frames.subscriber.counters().writers == 1; }));
  ASSERT_TRUE(frames.publish(example.image(ImageEncoding::kJpeg, 100, 100)));
  ASSERT_TRUE(late_frames.wait_for(1));
  EXPECT_EQ(late_frames.received().front().sample.sequence, 21U);
}

TEST_F(RoundTrip, PacedFramesAllArrive) {
  ParticipantOptions options = loopback("paced");
  options.max_bytes_per_second = 4e6;
  const Participant paced(options);
  InboxOf<ImageSample> inbox(there, topics::kWearableImageCompressed);
  Publisher<ImageSample> publisher(paced, topics::kWearableImageCompressed);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  for (int i = 0; i < 10; ++i)
    ASSERT_TRUE(publisher.publish(example.image(ImageEncoding::kJpeg, 200, 200)));
  EXPECT_TRUE(inbox.wait_for(10));
}

TEST_F(RoundTrip, SharedMemoryCarriesFramesToo) {
  ParticipantOptions options = loopback("shared");
  options.shared_memory = true;
  const Participant sender(options);
  const Participant receiver(options);
  InboxOf<ImageSample> inbox(receiver, topics::kWearableImage);
  Publisher<ImageSample> publisher(sender, topics::kWearableImage);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  const ImageSample frame = example.image(ImageEncoding::kMono8, 752, 480);
  ASSERT_TRUE(publisher.publish(frame));
  ASSERT_TRUE(inbox.wait_for(1));
  expect_equal(inbox.received().front().sample, frame);
}

TEST_F(RoundTrip, ThrowingCallbackIsCountedAndTheNextSampleStillComes) {
  int calls = 0;
  const Subscriber<AhrsSample> subscriber(there, topics::kWearableImu, [&](AhrsSample&&, const Reception&) {
    if (++calls == 1) throw std::runtime_error("the first is unlucky");
  });
  Publisher<AhrsSample> publisher(here, topics::kWearableImu);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  publisher.publish(example.ahrs());
  publisher.publish(example.ahrs());
  EXPECT_TRUE(eventually([&] { return subscriber.counters().received == 1; }));
  EXPECT_EQ(subscriber.counters().callback_failed, 1U);
}

TEST_F(RoundTrip, SampleThatCannotBeSaidIsRefusedAndCounted) {
  Publisher<ImageSample> raw(here, topics::kWearableImage);
  EXPECT_FALSE(raw.publish(example.image(ImageEncoding::kJpeg, 10, 10)));
  EXPECT_EQ(raw.counters().refused, 1U);
  EXPECT_EQ(raw.counters().sent, 0U);
}

}  // namespace
}  // namespace cosight::transport
