#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <fstream>
#include <mutex>
#include <optional>
#include <random>
#include <sstream>
#include <string>

#include "shared/transport/publisher.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"
#include "tests/shared/transport/raw_writer.hpp"

namespace cosight::transport {
namespace {

/// The publisher of test_peer.cpp in a process of its own.
class PeerProcess {
 public:
  PeerProcess() {
    std::string program = COSIGHT_BINARY_DIR "/tests/transport_test_peer";
    std::string domain = std::to_string(own_domain());
    std::array<char*, 3> arguments = {program.data(), domain.data(), nullptr};
    if (posix_spawn(&process_, program.c_str(), nullptr, nullptr, arguments.data(), environ) != 0) {
      throw std::runtime_error("can't start " + program);
    }
  }
  ~PeerProcess() { kill_hard(); }
  PeerProcess(const PeerProcess&) = delete;
  PeerProcess& operator=(const PeerProcess&) = delete;

  void kill_hard() {
    if (process_ <= 0) return;
    kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = 0;
  }

 private:
  pid_t process_ = 0;
};

TEST(Peers, KilledPublisherIsNoticedAndItsSuccessorHeard) {
  const Participant participant(loopback("robot"));
  const InboxOf<HeartbeatSample> heartbeats(participant, topics::kWearableHeartbeat);
  std::mutex mutex;
  WriterId last_heard{};
  std::optional<WriterId> gone;
  const Subscriber<HeartbeatSample> watch(
      participant, topics::kWearableHeartbeat,
      [&](HeartbeatSample&&, const Reception& reception) {
        const std::lock_guard lock(mutex);
        last_heard = reception.writer_id;
      },
      [&](const WriterId& writer) {
        const std::lock_guard lock(mutex);
        gone = writer;
      });
  InboxOf<ImageSample> frames(participant, topics::kWearableImageCompressed);

  std::optional<PeerProcess> peer(std::in_place);
  ASSERT_TRUE(frames.wait_for(5, 10000ms));
  ASSERT_TRUE(eventually([&] { return heartbeats.subscriber.counters().received > 5; }));
  EXPECT_EQ(heartbeats.subscriber.counters().liveliness_lost, 0U);

  peer->kill_hard();
  // Liveliness falls after 0.5 s, long before the participant is given up after 2 s.
  ASSERT_TRUE(eventually([&] { return heartbeats.subscriber.counters().liveliness_lost == 1; }, 10000ms));
  EXPECT_EQ(heartbeats.subscriber.counters().writers, 1);
  const auto says_who = [&] {
    const std::lock_guard lock(mutex);
    return gone == last_heard;
  };
  EXPECT_TRUE(eventually(says_who));
  ASSERT_TRUE(eventually([&] { return heartbeats.subscriber.counters().writers == 0; }, 10000ms));
  ASSERT_TRUE(eventually([&] { return participant.peers().lost == 1; }, 10000ms));
  const auto before = frames.received();

  peer.emplace();
  ASSERT_TRUE(frames.wait_for(before.size() + 5, 10000ms));
  const auto after = frames.received();
  EXPECT_NE(after.back().reception.writer_id, before.back().reception.writer_id);
  EXPECT_LT(after[before.size()].sample.sequence, before.back().sample.sequence + 20);  // it counts from anew
  EXPECT_EQ(frames.subscriber.counters().lost, 0U);
  EXPECT_EQ(frames.subscriber.counters().matched, 2U);
  EXPECT_EQ(frames.subscriber.counters().unmatched, 1U);
}

TEST(Peers, ReaderThatLeavesAndReturnsIsCountedAndServed) {
  const Participant wearable(loopback("wearable"));
  Publisher<ImageSample> publisher(wearable, topics::kWearableImageCompressed);
  ExampleSamples example;
  const ImageSample frame = example.image(ImageEncoding::kJpeg, 100, 100);
  for (int visit = 1; visit <= 3; ++visit) {
    const Participant robot(loopback("robot"));
    InboxOf<ImageSample> inbox(robot, topics::kWearableImageCompressed);
    ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
    ASSERT_TRUE(eventually([&] { return inbox.subscriber.counters().writers == 1; }));
    ASSERT_TRUE(publisher.publish(frame));
    ASSERT_TRUE(inbox.wait_for(1));
    EXPECT_EQ(publisher.counters().matched, static_cast<std::uint64_t>(visit));
  }
  ASSERT_TRUE(eventually([&] { return publisher.counters().readers == 0; }));
  EXPECT_EQ(publisher.counters().unmatched, 3U);
}

TEST(Peers, PublisherWithoutAnyReaderNeitherBlocksNorFails) {
  const Participant wearable(loopback("wearable"));
  Publisher<ImageSample> publisher(wearable, topics::kWearableImageCompressed);
  ExampleSamples example;
  const ImageSample frame = example.image(ImageEncoding::kJpeg, 100, 100);
  EXPECT_FALSE(publisher.wait_for_readers(1, 10ms));
  for (int i = 0; i < 200; ++i)
    ASSERT_TRUE(publisher.publish(frame));
  EXPECT_EQ(publisher.counters().sent, 200U);
  EXPECT_EQ(publisher.counters().stalled, 0U);
}

TEST(Peers, AProcessKnowsWhatItSentItself) {
  const Participant here(loopback("here"));
  const Participant there(loopback("there"));
  InboxOf<AhrsSample> own(here, topics::kWearableImu);
  InboxOf<AhrsSample> other(there, topics::kWearableImu);
  Publisher<AhrsSample> publisher(here, topics::kWearableImu);
  ASSERT_TRUE(publisher.wait_for_readers(2, 5000ms));
  publisher.publish(ExampleSamples().ahrs());
  ASSERT_TRUE(own.wait_for(1));
  ASSERT_TRUE(other.wait_for(1));
  EXPECT_TRUE(own.received().front().reception.from_own_process);
  EXPECT_FALSE(other.received().front().reception.from_own_process);
}

TEST(Peers, NoiseFromAPeerIsCountedAndTheNextGoodSampleComesThrough) {
  const Participant robot(loopback("robot"));
  InboxOf<AhrsSample> inbox(robot, topics::kWearableImu);
  RawWriter peer(own_domain(), topics::kWearableImu.profile);
  ASSERT_TRUE(inbox.subscriber.wait_for_writers(1, 5000ms));
  ASSERT_TRUE(eventually([&] { return peer.has_reader(); }));

  ExampleSamples example;
  std::vector<std::uint8_t> good;
  ASSERT_EQ(encode(example.ahrs(), topics::kWearableImu.profile, good), Fault::kNone);
  std::vector<std::uint8_t> truncated(good.begin(), good.begin() + 40);
  std::vector<std::uint8_t> lying = good;
  lying[12] = lying[13] = lying[14] = lying[15] = 0xFF;  // the length of frame_id
  std::vector<std::uint8_t> noise(1000);
  std::mt19937_64 random(3);
  for (std::uint8_t& byte : noise)
    byte = static_cast<std::uint8_t>(random());
  const std::vector<std::uint8_t> huge(200'000, 0);

  for (const auto& payload : {truncated, lying, noise, huge, std::vector<std::uint8_t>{0, 1, 0, 0}, good}) {
    ASSERT_TRUE(peer.write(payload));
  }
  ASSERT_TRUE(inbox.wait_for(1));
  EXPECT_EQ(inbox.subscriber.counters().invalid, 5U);
  EXPECT_EQ(inbox.subscriber.counters().lost, 0U);
}

TEST(Peers, WriterThatOffersLessIsCountedAsIncompatible) {
  const Participant robot(loopback("robot"));
  const InboxOf<AhrsSample> inbox(robot, topics::kWearableImu);
  const RawWriter best_effort(own_domain(), topics::kWearableImu.profile, false);
  EXPECT_TRUE(eventually([&] { return inbox.subscriber.counters().incompatible_qos == 1; }));
  EXPECT_EQ(inbox.subscriber.counters().writers, 0);
}

// Of this machine, so other programs may add to it: only lower bounds are safe.
std::uint64_t datagrams_sent() {
  std::ifstream file("/proc/net/snmp");
  std::string line;
  std::uint64_t sent = 0;
  while (std::getline(file, line)) {
    std::istringstream words(line);
    std::string protocol;
    std::uint64_t in = 0;
    std::uint64_t no_port = 0;
    std::uint64_t errors = 0;
    if (words >> protocol && protocol == "Udp:" && words >> in >> no_port >> errors) words >> sent;
  }
  return sent;
}

TEST(Datagrams, FrameLeavesInSmallOnesByDefault) {
  if (datagrams_sent() == 0) GTEST_SKIP() << "/proc/net/snmp counts nothing here";
  const Participant here(loopback("here"));
  const Participant there(loopback("there"));
  InboxOf<ImageSample> inbox(there, topics::kWearableImage);
  Publisher<ImageSample> publisher(here, topics::kWearableImage);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  ExampleSamples example;
  const std::uint64_t before = datagrams_sent();
  publisher.publish(example.image(ImageEncoding::kMono8, 752, 480));
  ASSERT_TRUE(inbox.wait_for(1));
  EXPECT_GT(datagrams_sent() - before, 752U * 480U / 1400U);
}

TEST(Datagrams, ParticipantThatSendsSmallOnesStillReceivesLargeOnes) {
  ParticipantOptions large = loopback("large");
  large.max_message_size = 65500;
  const Participant here(large);
  const Participant there(loopback("small"));
  InboxOf<ImageSample> inbox(there, topics::kWearableImage);
  Publisher<ImageSample> publisher(here, topics::kWearableImage);
  ASSERT_TRUE(publisher.wait_for_readers(1, 5000ms));
  ExampleSamples example;
  publisher.publish(example.image(ImageEncoding::kMono8, 752, 480));
  EXPECT_TRUE(inbox.wait_for(1));
}

}  // namespace
}  // namespace cosight::transport
