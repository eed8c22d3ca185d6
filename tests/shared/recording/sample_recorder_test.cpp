#include "shared/recording/sample_recorder.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "shared/recording/recording_source.hpp"
#include "tests/shared/recording/example_recording.hpp"
#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::recording {
namespace {

TEST(SampleRecorder, WritesWhatARecordingSourceReads) {
  transport::ExampleSamples example;
  const ImageSample image = example.image(ImageEncoding::kJpeg, 30, 20);
  const AhrsSample ahrs = example.ahrs();
  const WearerPoseSample pose = example.wearer_pose(true);
  const CameraModel camera = example.camera_info(Distortion::kRadtan).camera;
  MemorySink sink;
  McapWriter writer(sink);
  SampleRecorder recorder(writer);
  ASSERT_TRUE(recorder.write(Agent::kRobot, camera, image.stamp));
  ASSERT_TRUE(recorder.write(Agent::kRobot, Sample(image)));
  ASSERT_TRUE(recorder.write(Agent::kWearer, Sample(ahrs)));
  ASSERT_TRUE(recorder.write(Agent::kRobot, Sample(pose)));
  writer.close();

  const McapReader reader = reader_of(sink.bytes());
  EXPECT_EQ(recorded_robot_camera(reader)->fx, camera.fx);
  RecordingSource source(reader);
  EXPECT_TRUE(std::holds_alternative<CameraInfoSample>(source.next()->content));
  const auto frame = source.next();
  EXPECT_EQ(frame->from, Agent::kRobot);
  EXPECT_EQ(frame->log_time, image.stamp);
  transport::expect_equal(std::get<ImageSample>(std::get<Sample>(frame->content)), image);
  const auto orientation = source.next();
  EXPECT_EQ(orientation->from, Agent::kWearer);
  transport::expect_equal(std::get<AhrsSample>(std::get<Sample>(orientation->content)), ahrs);
  transport::expect_equal(std::get<WearerPoseSample>(std::get<Sample>(source.next()->content)), pose);
  EXPECT_FALSE(source.next());
  EXPECT_EQ(source.delivered(), 4U);
  EXPECT_EQ(source.unusable(), 0U);
}

TEST(SampleRecorder, RefusesWhatAMessageCannotSay) {
  transport::ExampleSamples example;
  AhrsSample ahrs = example.ahrs();
  ahrs.acceleration_H.x() = std::numeric_limits<double>::quiet_NaN();
  MemorySink sink;
  McapWriter writer(sink);
  EXPECT_FALSE(SampleRecorder(writer).write(Agent::kWearer, Sample(ahrs)));
  EXPECT_EQ(writer.messages(), 0U);
}

}  // namespace
}  // namespace cosight::recording
