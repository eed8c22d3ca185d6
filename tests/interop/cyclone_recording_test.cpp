#include <gtest/gtest.h>

#include "shared/recording/recording_source.hpp"
#include "shared/recording/replayer.hpp"
#include "shared/recording/sample_recorder.hpp"
#include "tests/interop/cyclone_peer.hpp"
#include "tests/shared/recording/dds_recording.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::recording {
namespace {

using transport::CyclonePeer;
using transport::loopback;

TEST(CycloneRecording, WhatAnotherVendorSendsIsRecorded) {
  const ScratchFolder folder;
  const transport::Participant recorder(loopback("recorder"));
  RecorderOptions options;
  options.path = folder / "cyclone.mcap";
  {
    RunningRecorder running(recorder, options);
    const CyclonePeer cyclone("send");
    ASSERT_TRUE(running.has_received(6));
    EXPECT_EQ(running.finish().counters.lost, 0U);
  }
  const McapReader reader(options.path);
  RecordingSource source(reader);
  int images = 0;
  int orientations = 0;
  while (const auto event = source.next()) {
    EXPECT_EQ(event->from, Agent::kWearer);
    const auto& sample = std::get<Sample>(event->content);
    EXPECT_EQ(stamp_of(sample), 1'700'000'000'123'456'789);
    if (const auto* const image = std::get_if<ImageSample>(&sample)) {
      ++images;
      EXPECT_EQ(image->bytes.at(1000), static_cast<std::uint8_t>(1000 * 7 + 1000 / 320));
    } else {
      ++orientations;
      EXPECT_EQ(std::get<AhrsSample>(sample).acceleration_H, Eigen::Vector3d(4, 5, 6));
    }
  }
  EXPECT_GE(images, 2);
  EXPECT_GE(orientations, 2);
  EXPECT_EQ(source.unusable(), 0U);
}

TEST(CycloneRecording, AReplayIsReceivedByAnotherVendor) {
  const ScratchFolder folder;
  transport::ExampleSamples example;
  const auto path = folder / "ours.mcap";
  const ImageSample raw = example.image(ImageEncoding::kMono8, 752, 480);
  {
    FileSink sink(path);
    McapWriter writer(sink);
    SampleRecorder samples(writer);
    ASSERT_TRUE(samples.write(Agent::kWearer, example.camera_info(Distortion::kRadtan).camera, raw.stamp));
    ASSERT_TRUE(samples.write(Agent::kWearer, raw));
    ASSERT_TRUE(samples.write(Agent::kWearer, example.image(ImageEncoding::kJpeg, 300, 200)));
    ASSERT_TRUE(samples.write(Agent::kWearer, example.ahrs()));
    writer.close();
  }
  const McapReader reader(path);
  const transport::Participant sender(loopback("sender"));
  SteadyClock clock;
  ReplayerOptions options;
  options.expected_readers = {"/cosight/wearable/image", "/cosight/wearable/image/compressed",
                              "/cosight/wearable/camera_info", "/cosight/wearable/imu"};
  options.patience = 15.0;
  CyclonePeer cyclone("receive");
  Replayer replayer(sender, reader, options, clock);
  ReplayControl control;
  const std::atomic<bool> stop = false;
  const ReplaySummary summary = replayer.run(stop, control);
  EXPECT_EQ(summary.sent, 4U);
  EXPECT_TRUE(summary.without_reader.empty());
  ASSERT_EQ(cyclone.wait(), 0);
  const auto printed = cyclone.printed();
  EXPECT_EQ(printed.at("image.data.length"), std::to_string(raw.bytes.size()));
  EXPECT_EQ(printed.at("imu.frame_id"), "wearer_head");
}

}  // namespace
}  // namespace cosight::recording
