#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

#include "shared/transport/network.hpp"
#include "shared/transport/publisher.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

TEST(Options, OutOfRangeIsAnErrorThatNamesTheValue) {
  const auto message_of = [](const ParticipantOptions& options) -> std::string {
    try {
      const Participant participant(options);
    } catch (const TransportError& error) {
      return error.what();
    }
    return {};
  };
  ParticipantOptions options = loopback("wrong");
  options.domain = 233;
  EXPECT_NE(message_of(options).find("domain 233"), std::string::npos);
  options = loopback("wrong");
  options.max_message_size = 70000;
  EXPECT_NE(message_of(options).find("max_message_size 70000"), std::string::npos);
  options = loopback("wrong");
  options.interfaces = {"nosuch0"};
  EXPECT_NE(message_of(options).find("\"nosuch0\" does not exist"), std::string::npos);
  options = loopback("wrong");
  options.peers = {"not an address"};
  EXPECT_NE(message_of(options).find("\"not an address\""), std::string::npos);
  options = loopback("wrong");
  options.profile_file = "/nowhere/dds.xml";
  EXPECT_NE(message_of(options).find("/nowhere/dds.xml does not exist"), std::string::npos);
}

TEST(Options, BrokenProfileFileIsAnErrorThatNamesIt) {
  const std::string path = ::testing::TempDir() + "cosight_broken_profile.xml";
  std::ofstream(path) << "<dds><profiles><participant";
  ParticipantOptions options = loopback("broken");
  options.profile_file = path;
  EXPECT_THROW(const Participant participant(options), TransportError);
  std::remove(path.c_str());
}

TEST(Options, ProfileFileReplacesTheOptions) {
  ParticipantOptions options = loopback("ignored");
  options.profile_file = COSIGHT_SOURCE_DIR "/config/dds/example.xml";
  const Participant profiled(options);
  ASSERT_TRUE(profiled.warnings().empty());
  const Participant witness(loopback("witness"));
  ASSERT_TRUE(eventually([&] { return witness.peers().discovered == 1; }));

  // The example gives heartbeats a liveliness lease of 2 s: too little for a reader that asks for 0.5 s.
  const Publisher<HeartbeatSample> heartbeats(profiled, topics::kWearableHeartbeat);
  const InboxOf<HeartbeatSample> inbox(witness, topics::kWearableHeartbeat);
  EXPECT_TRUE(eventually([&] { return inbox.subscriber.counters().incompatible_qos == 1; }));
}

TEST(Options, ProfileFileMayBeReadAgainByALaterParticipant) {
  ParticipantOptions options = loopback("again");
  options.profile_file = COSIGHT_SOURCE_DIR "/config/dds/example.xml";
  { const Participant first(options); }
  EXPECT_NO_THROW(const Participant second(options));
}

TEST(Options, RefusedSocketBufferIsExplained) {
  EXPECT_EQ(refused_socket_buffer(1000), "");
  const std::string warning = refused_socket_buffer(2'000'000'000);
  EXPECT_NE(warning.find("sysctl -w net.core.rmem_max=2000000000"), std::string::npos);
}

TEST(Options, InterfaceIsFoundByNameAndByAddress) {
  EXPECT_EQ(ipv4_of_interface("lo"), "127.0.0.1");
  EXPECT_EQ(ipv4_of_interface("127.0.0.1"), "127.0.0.1");
}

TEST(Topics, FollowRos2sNames) {
  for (const TopicProfile* topic : all_topics()) {
    EXPECT_TRUE(topic->name.starts_with("rt/cosight/")) << topic->name;
    EXPECT_NE(type_name(topic->kind).find("::msg::dds_::"), std::string_view::npos);
    EXPECT_TRUE(type_name(topic->kind).ends_with("_"));
    EXPECT_GE(topic->depth, 1);
    EXPECT_FALSE(topic->frame_id.empty());
  }
}

}  // namespace
}  // namespace cosight::transport
