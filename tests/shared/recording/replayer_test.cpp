#include "shared/recording/replayer.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <thread>

#include "shared/recording/file_bytes.hpp"
#include "shared/recording/recorded_topic.hpp"
#include "shared/transport/topics.hpp"
#include "tests/shared/recording/dds_recording.hpp"
#include "tests/shared/recording/example_recording.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::recording {
namespace {

using testing::ElementsAre;
using transport::BlindReception;
using transport::BlindTopic;
using transport::eventually;
using transport::loopback;
namespace profiles = transport::profiles;

constexpr Stamp kBegin = 1'700'000'000'000'000'000;
constexpr Stamp kMillisecond = 1'000'000;

BlindTopic topic_of(const transport::TopicProfile& profile) {
  return {std::string(profile.name), std::string(transport::type_name(profile.kind)), false, {}};
}

/// 40 AHRS samples in 400 ms, and a calibration before the first.
void write_recording(const std::filesystem::path& path) {
  transport::ExampleSamples example;
  FileSink sink(path);
  McapWriter writer(sink, {});
  const auto add = [&](const transport::TopicProfile& profile) {
    const RecordedTopic topic = describe(topic_of(profile), MessageSchemas::built_in());
    const SchemaId schema = writer.add_schema(topic.schema.name, topic.schema.encoding, topic.schema.text);
    return writer.add_channel(topic.channel.topic, "cdr", schema, topic.channel.metadata);
  };
  const ChannelId imu = add(profiles::kWearableImu);
  const ChannelId info = add(profiles::kWearableCameraInfo);
  Bytes payload;
  transport::encode(example.camera_info(Distortion::kRadtan), profiles::kWearableCameraInfo, payload);
  writer.write(Message{info, 1, kBegin, kBegin - 5, payload});
  for (std::uint32_t i = 0; i < 40; ++i) {
    transport::encode(example.ahrs(), profiles::kWearableImu, payload);
    const Stamp stamp = kBegin + (i + 1) * 10 * kMillisecond;
    writer.write(Message{imu, i + 1, stamp, stamp - 77, payload});
  }
  writer.close();
}

class Replay : public testing::Test {
 protected:
  Replay() { write_recording(file); }

  ReplaySummary replay(const ReplayerOptions& options) {
    Replayer replayer(sender, reader(), options, clock);
    return replayer.run(stop, control);
  }
  const McapReader& reader() {
    if (!reader_) reader_ = std::make_unique<McapReader>(file);
    return *reader_;
  }
  std::vector<OwnedMessage> recorded() const { return messages_of(McapReader(folder / "again.mcap")); }
  RecorderOptions again() const {
    RecorderOptions options;
    options.path = folder / "again.mcap";
    return options;
  }

  ScratchFolder folder;
  std::filesystem::path file = folder / "first.mcap";
  transport::Participant sender{loopback("sender")};
  transport::Participant receiver{loopback("receiver")};
  std::atomic<bool> stop = false;
  ReplayControl control;
  SteadyClock clock;

 private:
  std::unique_ptr<McapReader> reader_;
};

TEST_F(Replay, SendsTheSameBytesWithTheSameStampsInTheSameRhythm) {
  RunningRecorder running(receiver, again());
  ReplayerOptions options;
  options.expected_readers = {"/cosight/wearable/imu", "/cosight/wearable/camera_info"};
  const ReplaySummary summary = replay(options);
  EXPECT_EQ(summary.sent, 41U);
  EXPECT_TRUE(summary.without_reader.empty());
  ASSERT_TRUE(running.has_received(41));
  running.finish();
  const auto before = messages_of(reader());
  const auto after = recorded();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT(after[i].payload.size() - before[i].payload.size(), 4U);  // the wire goes in fours
    EXPECT_TRUE(std::equal(before[i].payload.begin(), before[i].payload.end(), after[i].payload.begin()));
    EXPECT_EQ(after[i].publish_time, before[i].publish_time);
    EXPECT_EQ(after[i].topic, before[i].topic);
  }
  EXPECT_NEAR(to_seconds(after.back().log_time - after.front().log_time), 0.4, 0.1);
}

TEST_F(Replay, FromTheMiddleBeginsWithTheCalibration) {
  RunningRecorder running(receiver, again());
  ReplayerOptions options;
  options.start = 0.305;
  options.expected_readers = {"/cosight/wearable/imu", "/cosight/wearable/camera_info"};
  EXPECT_EQ(replay(options).sent, 11U);
  ASSERT_TRUE(running.has_received(11));
  running.finish();
  const auto after = recorded();
  EXPECT_EQ(after.front().topic, "/cosight/wearable/camera_info");
  EXPECT_EQ(after[1].publish_time, kBegin + 310 * kMillisecond - 77);
}

TEST_F(Replay, SelectsAndRenamesTopics) {
  RunningRecorder running(receiver, again());
  ReplayerOptions options;
  options.rate = 0.0;
  options.end = 0.105;
  options.topics.allow = {"*/imu"};
  options.remap = {{"/cosight/wearable/imu", "/another/imu"}};
  EXPECT_EQ(replay(options).sent, 10U);
  ASSERT_TRUE(running.has_received(10));
  running.finish();
  for (const OwnedMessage& message : recorded())
    EXPECT_EQ(message.topic, "/another/imu");
}

TEST_F(Replay, SaysThatNobodyListens) {
  ReplayerOptions options;
  options.rate = 0.0;
  options.patience = 0.0;
  EXPECT_THAT(replay(options).without_reader, ElementsAre("*"));
}

TEST_F(Replay, PausesAndGoesOneStep) {
  control.paused = true;
  ReplayerOptions options;
  options.patience = 0.0;
  Replayer replayer(sender, reader(), options, clock);
  std::atomic<std::uint64_t> sent = 0;
  std::thread thread(
      [&] { replayer.run(stop, control, [&](const ReplayerStatus& status) { sent = status.sent; }); });
  usleep(300'000);
  EXPECT_EQ(sent, 0U);
  control.steps = 2;
  EXPECT_TRUE(eventually([&] { return sent == 2; }));
  usleep(250'000);
  EXPECT_EQ(sent, 2U);
  control.paused = false;
  thread.join();
  EXPECT_GT(sent, 2U);
}

TEST_F(Replay, StartsAgainAtTheEndUntilItIsStopped) {
  RunningRecorder running(receiver, again());
  ReplayerOptions options;
  options.rate = 20.0;
  options.loop = true;
  std::thread thread([&] { EXPECT_GE(replay(options).sent, 100U); });
  EXPECT_TRUE(running.has_received(100));
  stop = true;
  thread.join();
  running.finish();
}

}  // namespace
}  // namespace cosight::recording
