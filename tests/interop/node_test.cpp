#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "shared/recording/file_bytes.hpp"
#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/mcap_writer.hpp"
#include "shared/recording/recorded_topic.hpp"
#include "shared/transport/codec.hpp"
#include "shared/transport/topics.hpp"
#include "tests/shared/transport/example_samples.hpp"

namespace cosight::recording {
namespace {

namespace fs = std::filesystem;
namespace topics = transport::topics;

/// Other people's programs, from the registry into the build tree.
class OtherPeoplesTools : public testing::Test {
 protected:
  static fs::path folder() { return fs::path(COSIGHT_BINARY_DIR) / "tests" / "node"; }
  static bool run(const std::string& command) {
    return std::system(("cd " + folder().string() + " && " + command).c_str()) == 0;  // NOLINT: one thread
  }

  static void SetUpTestSuite() {
    fs::create_directories(folder());
    for (const auto& entry : fs::directory_iterator(fs::path(COSIGHT_SOURCE_DIR) / "tests/interop/node"))
      fs::copy(entry.path(), folder() / entry.path().filename(), fs::copy_options::overwrite_existing);
    is_installed_ = run("npm ci --ignore-scripts --no-audit --no-fund --loglevel=error >npm.log 2>&1");
  }
  void SetUp() override {
    if (!is_installed_)
      GTEST_SKIP() << "Node.js, npm or its registry is not there; see " << folder() / "npm.log";
  }

  static bool is_installed_;
};
bool OtherPeoplesTools::is_installed_ = false;

class ExampleFile {
 public:
  explicit ExampleFile(const fs::path& path) : sink_(path), writer_(sink_, {.chunk_bytes = 50'000}) {
    writer_.write(Attachment{1, 2, "robot.yaml", "application/yaml", {'a'}});
    writer_.write(Metadata{"cosight.session", {{"host", "here"}}});
  }

  template <class Kind>
  void add(const transport::Topic<Kind>& topic, const Kind& sample) {
    const transport::TopicProfile& profile = topic.profile;
    const RecordedTopic recorded = describe(
        {std::string(profile.name), std::string(transport::type_name(profile.kind)), false, {}}, schemas_);
    const SchemaId schema =
        writer_.add_schema(recorded.schema.name, recorded.schema.encoding, recorded.schema.text);
    const ChannelId channel =
        writer_.add_channel(recorded.channel.topic, "cdr", schema, recorded.channel.metadata);
    Bytes payload;
    ASSERT_EQ(transport::encode(sample, profile, payload), transport::Fault::kNone);
    writer_.write(Message{channel, 1, 1'700'000'000'000'000'000 + channel, 77 + channel, payload});
    expect(recorded.channel.topic, "publishTime", 77 + channel);
    expect(recorded.channel.topic, "header.stamp.sec",
           transport::ExampleSamples::kStamp / kNanosecondsPerSecond);
    expect(recorded.channel.topic, "header.frame_id", profile.frame_id);
  }
  template <class Value>
  void expect(const std::string& topic, const std::string& field, const Value& value) {
    expected_ << topic << ' ' << field << ' ' << value << '\n';
  }
  void finish(const fs::path& expected) {
    writer_.close();
    std::ofstream(expected) << expected_.str();
  }

 private:
  MessageSchemas schemas_ = MessageSchemas::built_in();
  FileSink sink_;
  McapWriter writer_;
  std::ostringstream expected_;
};

/// As JavaScript prints numbers that are short in binary.
double rounded(double value) {
  return std::round(value * 64.0) / 64.0;
}

TEST_F(OtherPeoplesTools, ReadARecordingOfEveryTopicByIndexAndByStreaming) {
  transport::ExampleSamples example;
  const fs::path path = folder() / "ours.mcap";
  fs::remove(path);
  ExampleFile file(path);
  const ImageSample raw = example.image(ImageEncoding::kMono8, 300, 200);
  const ImageSample jpeg = example.image(ImageEncoding::kJpeg, 30, 20);
  AhrsSample ahrs = example.ahrs();
  ahrs.angular_velocity_H = ahrs.angular_velocity_H.unaryExpr(&rounded);
  OdometrySample odometry = example.odometry();
  odometry.T_WS.T.p = odometry.T_WS.T.p.unaryExpr(&rounded);
  file.add(topics::kWearableImageCompressed, jpeg);
  file.expect("/cosight/wearable/image/compressed", "format", "jpeg");
  file.expect("/cosight/wearable/image/compressed", "data.length", jpeg.bytes.size());
  file.expect("/cosight/wearable/image/compressed", "data.17", int{jpeg.bytes[17]});
  file.add(topics::kWearableImage, raw);
  file.expect("/cosight/wearable/image", "width", 300);
  file.expect("/cosight/wearable/image", "encoding", "mono8");
  file.expect("/cosight/wearable/image", "data.59999", int{raw.bytes[59'999]});
  file.add(topics::kWearableCameraInfo, example.camera_info(Distortion::kRadtan));
  file.expect("/cosight/wearable/camera_info", "k.0", "458.654");
  file.expect("/cosight/wearable/camera_info", "distortion_model", "plumb_bob");
  file.add(topics::kWearableImu, ahrs);
  file.expect("/cosight/wearable/imu", "angular_velocity.z", ahrs.angular_velocity_H.z());
  file.add(topics::kWearableHeartbeat, example.heartbeat());
  file.expect("/cosight/wearable/heartbeat", "instance_id", 0xFEDC'BA98'7654'3210);
  file.expect("/cosight/wearable/heartbeat", "orientations.gaps", 26);
  file.add(topics::kRobotWearerPose, example.wearer_pose(true));
  file.add(topics::kRobotOdometry, odometry);
  file.expect("/cosight/robot/odometry", "pose.pose.position.y", odometry.T_WS.T.p.y());
  file.add(topics::kRobotMap, example.cloud(1000));
  file.expect("/cosight/robot/map", "width", 1000);
  file.expect("/cosight/robot/map", "fields.3.name", "intensity");
  file.add(topics::kRobotOverlap, example.overlap());
  file.expect("/cosight/robot/overlap", "roi_in_robot_image.2.u", 5.5);
  file.expect("/cosight/robot/overlap", "outcome", "matched");
  file.finish(folder() / "expected.txt");
  EXPECT_TRUE(run("node read.mjs ours.mcap expected.txt"));
}

TEST_F(OtherPeoplesTools, WriteFilesThatAreReadHere) {
  ASSERT_TRUE(run("node write.mjs ."));
  for (const char* name : {"zstd", "lz4", "unchunked", "unindexed"}) {
    SCOPED_TRACE(name);
    const McapReader reader(folder() / (std::string(name) + ".mcap"));
    const McapContents& contents = reader.contents();
    EXPECT_EQ(contents.is_indexed, name == std::string("zstd") || name == std::string("lz4"));
    EXPECT_TRUE(contents.is_complete);
    EXPECT_EQ(contents.damaged, 0U);
    ASSERT_EQ(contents.messages, 50U);
    auto cursor = reader.messages();
    for (std::uint32_t i = 0; i < 50; ++i) {
      const auto message = cursor.next();
      ASSERT_TRUE(message);
      const Channel& channel = contents.channels.at(message->channel_id);
      EXPECT_EQ(channel.topic, i % 2 == 0 ? "/even" : "/odd");
      EXPECT_EQ(channel.metadata.at("key"), channel.topic);
      EXPECT_EQ(reader.schema_of(channel)->text, "uint8[] data");
      EXPECT_EQ(message->sequence, i);
      EXPECT_EQ(message->log_time, (i + 1) * 1000);
      EXPECT_EQ(message->publish_time, (i + 1) * 1000 - 1);
      EXPECT_EQ(Bytes(message->payload.begin(), message->payload.end()),
                Bytes(i, static_cast<std::uint8_t>(i)));
    }
    ASSERT_EQ(contents.attachments.size(), 1U);
    EXPECT_EQ(reader.attachment(contents.attachments[0]).value().data, (Bytes{'h', 'i'}));
    EXPECT_EQ(reader.metadata("writer")->entries.at("name"), name);
  }
}

}  // namespace
}  // namespace cosight::recording
