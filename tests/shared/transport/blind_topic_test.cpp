#include "shared/transport/blind_topic.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <optional>

#include "shared/transport/publisher.hpp"
#include "shared/transport/topics.hpp"
#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

struct Arrived {
  std::vector<std::uint8_t> payload;
  BlindReception reception;
};

class BlindInbox {
 public:
  BlindInbox(const Participant& participant, const BlindTopic& topic)
      : reader_(participant, topic,
                [this](std::vector<std::uint8_t>&& payload, const BlindReception& reception) {
                  const std::lock_guard lock(mutex_);
                  arrived_.push_back({std::move(payload), reception});
                }) {}

  std::vector<Arrived> wait_for(std::size_t count) {
    eventually([&] {
      const std::lock_guard lock(mutex_);
      return arrived_.size() >= count;
    });
    const std::lock_guard lock(mutex_);
    return arrived_;
  }

 private:
  std::mutex mutex_;
  std::vector<Arrived> arrived_;
  BlindReader reader_;
};

class BlindTopics : public testing::Test {
 protected:
  std::optional<DiscoveredWriter> discover(std::string_view topic) {
    std::optional<DiscoveredWriter> found;
    eventually([&] {
      for (const auto& writer : discovered_writers(there))
        if (writer.topic.name == topic) found = writer;
      return found.has_value();
    });
    return found;
  }

  Participant here{loopback("here")};
  Participant there{loopback("there")};
  ExampleSamples example;
};

TEST_F(BlindTopics, AWriterIsDiscoveredWithWhatItOffers) {
  const Publisher<HeartbeatSample> publisher(here, topics::kWearableHeartbeat);
  const auto writer = discover("rt/cosight/wearable/heartbeat");
  ASSERT_TRUE(writer);
  EXPECT_EQ(writer->topic.type, "cosight_msgs::msg::dds_::Heartbeat_");
  EXPECT_TRUE(writer->topic.qos.reliable);
  EXPECT_TRUE(writer->topic.qos.transient_local);
  EXPECT_NEAR(writer->topic.qos.liveliness_lease, 0.5, 1e-6);
  EXPECT_EQ(writer->topic.qos.deadline, 0.0);
  EXPECT_FALSE(writer->topic.keyed);
}

TEST_F(BlindTopics, AWriterThatLeftIsForgotten) {
  {
    const Publisher<AhrsSample> publisher(here, topics::kWearableImu);
    ASSERT_TRUE(discover("rt/cosight/wearable/imu"));
  }
  EXPECT_TRUE(eventually([&] { return discovered_writers(there).empty(); }));
}

TEST_F(BlindTopics, APayloadIsReceivedByteForByte) {
  Publisher<ImageSample> publisher(here, topics::kWearableImageCompressed);
  const ImageSample image = example.image(ImageEncoding::kJpeg, 300, 200);
  publisher.publish(image);
  const auto writer = discover("rt/cosight/wearable/image/compressed");
  ASSERT_TRUE(writer);
  BlindInbox inbox(there, writer->topic);  // comes late and gets what was sent before
  const auto arrived = inbox.wait_for(1);
  ASSERT_EQ(arrived.size(), 1U);
  std::vector<std::uint8_t> expected;
  encode(image, profiles::kWearableImageCompressed, expected);
  EXPECT_EQ(arrived[0].payload, expected);
  EXPECT_EQ(arrived[0].reception.writer_id, writer->id);
  EXPECT_EQ(arrived[0].reception.sequence, 1U);
  EXPECT_GT(arrived[0].reception.source_stamp, 0);
}

TEST_F(BlindTopics, AReplayedPayloadKeepsItsSourceStampAndIsReadAsASample) {
  BlindTopic topic{.name = std::string(profiles::kWearableImu.name),
                   .type = std::string(type_name(MessageKind::kImu)),
                   .keyed = false,
                   .qos = {}};
  BlindWriter writer(here, topic, 10);
  InboxOf<AhrsSample> typed(there, topics::kWearableImu);
  BlindInbox blind(there, topic);
  ASSERT_TRUE(eventually([&] { return writer.readers() == 2; }));
  std::vector<std::uint8_t> payload;
  const AhrsSample sample = example.ahrs();
  encode(sample, profiles::kWearableImu, payload);
  constexpr Stamp kLongAgo = 1'234'567'890'123'456'789;
  ASSERT_TRUE(writer.write(payload, kLongAgo));
  ASSERT_TRUE(typed.wait_for(1));
  expect_equal(typed.received().front().sample, sample);
  const auto arrived = blind.wait_for(1);
  ASSERT_EQ(arrived.size(), 1U);
  EXPECT_EQ(arrived[0].payload, payload);
  EXPECT_EQ(arrived[0].reception.source_stamp, kLongAgo);
  EXPECT_TRUE(writer.wait_until_delivered(5000ms));
}

TEST_F(BlindTopics, BestEffortKeysAndPartitionsAreMirrored) {
  BlindTopic topic{.name = "free/topic", .type = "free::Type", .keyed = true, .qos = {}};
  topic.qos.reliable = false;
  topic.qos.transient_local = false;
  topic.qos.partitions = {"somewhere"};
  BlindWriter writer(here, topic, 10);
  const auto discovered = discover("free/topic");
  ASSERT_TRUE(discovered);
  EXPECT_TRUE(discovered->topic.keyed);
  EXPECT_EQ(discovered->topic.qos, topic.qos);
  BlindInbox inbox(there, discovered->topic);
  ASSERT_TRUE(eventually([&] { return writer.readers() == 1; }));
  ASSERT_TRUE(eventually([&] {
    writer.write(std::vector<std::uint8_t>{0, 1, 0, 0, 42, 43, 44, 45}, 7);
    return !inbox.wait_for(1).empty();
  }));
  EXPECT_THAT(inbox.wait_for(1)[0].payload, testing::ElementsAre(0, 1, 0, 0, 42, 43, 44, 45));
}

TEST_F(BlindTopics, ASecondTypeUnderATopicsNameIsRefused) {
  const Publisher<AhrsSample> publisher(here, topics::kWearableImu);
  EXPECT_THROW(BlindReader(here, {std::string(profiles::kWearableImu.name), "another::Type", false, {}},
                           [](std::vector<std::uint8_t>&&, const BlindReception&) {}),
               TransportError);
}

}  // namespace
}  // namespace cosight::transport
