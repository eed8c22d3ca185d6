#include <gmock/gmock.h>
#include <sys/resource.h>
#include <csignal>

#include <optional>

#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/recording_error.hpp"
#include "shared/transport/publisher.hpp"
#include "shared/transport/topics.hpp"
#include "tests/shared/recording/dds_recording.hpp"
#include "tests/shared/recording/example_recording.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::recording {
namespace {

using testing::ElementsAre;
using transport::BlindTopic;
using transport::BlindWriter;
using transport::loopback;
using transport::Participant;
using transport::Publisher;
namespace topics = transport::topics;
namespace profiles = transport::profiles;

class Recording : public testing::Test {
 protected:
  Bytes payload_of(const AhrsSample& sample) {
    Bytes payload;
    transport::encode(sample, profiles::kWearableImu, payload);
    return payload;
  }

  RecorderOptions recording_at(const char* name) const {
    RecorderOptions options;
    options.path = folder / name;
    return options;
  }

  Participant agent{loopback("agent")};
  Participant recorder{loopback("recorder")};
  ScratchFolder folder;
  transport::ExampleSamples example;
};

TEST_F(Recording, HoldsEveryTopicAsItWasOnTheWire) {
  Publisher<AhrsSample> ahrs(agent, topics::kWearableImu);
  Publisher<CameraInfoSample> calibration(agent, topics::kWearableCameraInfo);
  BlindWriter unknown(agent, {"free/topic", "free::Type", false, {}}, 10);
  calibration.publish(example.camera_info(Distortion::kRadtan));  // before the recorder is there
  SessionNotes notes{{{1, 2, "robot.yaml", "application/yaml", {'x'}}},
                     {"cosight.session", {{"host", "here"}}}};
  RunningRecorder running(recorder, recording_at("trial.mcap"), notes);
  ASSERT_TRUE(ahrs.wait_for_readers(1, std::chrono::seconds(5)));
  ASSERT_TRUE(transport::eventually([&] { return unknown.readers() == 1; }));
  std::vector<Bytes> sent;
  for (int i = 0; i < 100; ++i) {
    AhrsSample sample = example.ahrs();
    sample.stamp += i;
    ahrs.publish(sample);
    sent.push_back(payload_of(sample));
  }
  constexpr Stamp kLongAgo = 1'234'567'890'123'456'789;
  unknown.write(Bytes{0, 1, 0, 0, 1, 2, 3, 4}, kLongAgo);
  ASSERT_TRUE(running.has_received(102));
  const RecordedSummary summary = running.finish();
  EXPECT_EQ(summary.messages, 102U);
  EXPECT_EQ(summary.counters.lost, 0U);
  EXPECT_TRUE(summary.unrecorded.empty());

  const McapReader reader(folder / "trial.mcap");
  EXPECT_TRUE(reader.contents().is_indexed);
  EXPECT_EQ(reader.contents().profile, "ros2");
  std::vector<Bytes> ahrs_payloads;
  std::vector<std::string> others;
  for (const OwnedMessage& message : messages_of(reader)) {
    if (message.topic == "/cosight/wearable/imu")
      ahrs_payloads.push_back(message.payload);
    else
      others.push_back(message.topic);
    if (message.topic == "free/topic") {
      EXPECT_EQ(message.publish_time, kLongAgo);
      EXPECT_EQ(message.payload, (Bytes{0, 1, 0, 0, 1, 2, 3, 4}));
    }
  }
  EXPECT_EQ(ahrs_payloads, sent);
  EXPECT_THAT(others, testing::UnorderedElementsAre("/cosight/wearable/camera_info", "free/topic"));
  for (const auto& [id, channel] : reader.contents().channels) {
    const Schema* schema = reader.schema_of(channel);
    ASSERT_NE(schema, nullptr);
    EXPECT_EQ(schema->encoding, channel.topic == "free/topic" ? "" : "ros2msg");
    if (channel.topic == "free/topic") {
      EXPECT_EQ(schema->name, "free/Type");
    }
    const BlindTopic topic = blind_topic(channel, schema);
    EXPECT_TRUE(topic.qos.reliable && topic.qos.transient_local);
  }
  EXPECT_EQ(reader.metadata("cosight.session")->entries.at("host"), "here");
  EXPECT_EQ(reader.metadata("cosight.losses")->entries.at("/cosight/wearable/imu"),
            "received=100 lost=0 refused=0");
  EXPECT_EQ(reader.contents().attachments.at(0).name, "robot.yaml");
}

TEST_F(Recording, LeavesOutWhatIsDeniedOrNotAllowed) {
  const BlindWriter a(agent, {"rt/a/x", "T", false, {}}, 1);
  const BlindWriter b(agent, {"rt/a/y", "T", false, {}}, 1);
  BlindWriter c(agent, {"rt/b/x", "T", false, {}}, 1);
  RecorderOptions options = recording_at("t.mcap");
  options.topics.allow = {"*/x"};
  options.topics.deny = {"/a/*"};
  RunningRecorder running(recorder, options);
  ASSERT_TRUE(transport::eventually([&] { return c.readers() == 1; }));
  usleep(100'000);
  EXPECT_EQ(a.readers() + b.readers(), 0);
  running.finish();
}

TEST_F(Recording, GoesOnInAnotherFileWithoutLosingAMessage) {
  Publisher<AhrsSample> ahrs(agent, topics::kWearableImu);
  RecorderOptions options = recording_at("trial.mcap");
  options.split.max_bytes = 20'000;
  RunningRecorder running(recorder, options);
  ASSERT_TRUE(ahrs.wait_for_readers(1, std::chrono::seconds(5)));
  std::vector<Bytes> sent;
  for (int i = 0; i < 180; ++i) {
    AhrsSample sample = example.ahrs();
    sample.stamp += i;
    ahrs.publish(sample);
    sent.push_back(payload_of(sample));
  }
  ASSERT_TRUE(running.has_received(180));
  const RecordedSummary summary = running.finish();
  ASSERT_GT(summary.files.size(), 2U);
  EXPECT_EQ(summary.messages, 180U);
  std::vector<Bytes> found;
  for (const auto& path : summary.files) {
    const McapReader reader(path);
    EXPECT_TRUE(reader.contents().is_indexed);
    for (const OwnedMessage& message : messages_of(reader))
      found.push_back(message.payload);
  }
  EXPECT_EQ(found, sent);
}

TEST_F(Recording, TheRingKeepsTheLastSecondsAndTheCalibration) {
  BlindTopic volatile_topic{"rt/stream", "T", false, {}};
  volatile_topic.qos.reliable = false;
  volatile_topic.qos.transient_local = false;
  BlindWriter stream(agent, volatile_topic, 100);
  Publisher<CameraInfoSample> calibration(agent, topics::kWearableCameraInfo);
  RecorderOptions options = recording_at("ring.mcap");
  options.ring_seconds = 0.5;
  RunningRecorder running(recorder, options);
  ASSERT_TRUE(transport::eventually([&] { return stream.readers() == 1; }));
  calibration.publish(example.camera_info(Distortion::kRadtan));
  stream.write(Bytes{0, 1, 0, 0, 1, 0, 0, 0}, 1);
  usleep(900'000);
  stream.write(Bytes{0, 1, 0, 0, 2, 0, 0, 0}, 2);
  ASSERT_TRUE(running.has_received(3));
  running.save_ring();
  const RecordedSummary summary = running.finish();
  ASSERT_EQ(summary.files.size(), 1U);
  std::vector<std::string> found;
  for (const OwnedMessage& message : messages_of(McapReader(summary.files[0])))
    found.push_back(message.topic + std::to_string(message.payload.at(4)));
  EXPECT_EQ(found.size(), 2U);
  EXPECT_EQ(found.back(), "/stream2");
}

TEST_F(Recording, ThatAlreadyExistsIsNotOverwritten) {
  const auto once = [&] { RunningRecorder(recorder, recording_at("trial.mcap")).finish(); };
  once();
  EXPECT_THROW(once(), RecordingError);
  EXPECT_THROW(RunningRecorder(recorder, recording_at("no/such/folder.mcap")), RecordingError);
}

/// The file may not get larger: as when the disk is full.
class LimitedFileSize {
 public:
  explicit LimitedFileSize(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limited{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limited);
  }
  ~LimitedFileSize() { ::setrlimit(RLIMIT_FSIZE, &before_); }
  LimitedFileSize(const LimitedFileSize&) = delete;
  LimitedFileSize& operator=(const LimitedFileSize&) = delete;

 private:
  rlimit before_{};
};

TEST_F(Recording, AFullDiskIsAnErrorAndWhatWasWrittenStays) {
  BlindWriter stream(agent, {"rt/stream", "T", false, {}}, 100);
  const LimitedFileSize limit(200'000);
  RecorderOptions options = recording_at("full.mcap");
  options.writer.chunk_bytes = 50'000;
  RunningRecorder running(recorder, options);
  ASSERT_TRUE(transport::eventually([&] { return stream.readers() == 1; }));
  Bytes payload(40'000);
  for (int i = 0; i < 10; ++i) {
    for (std::uint8_t& byte : payload)
      byte = static_cast<std::uint8_t>(example.random());
    stream.write(payload, i);
  }
  usleep(700'000);
  EXPECT_THROW(running.finish(), RecordingError);
  const McapReader reader(folder / "full.mcap");
  EXPECT_GE(reader.contents().messages, 2U);
  EXPECT_EQ(reader.contents().damaged, 0U);
}

}  // namespace
}  // namespace cosight::recording
