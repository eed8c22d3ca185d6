#include "shared/transport/agent_presence.hpp"

#include <gtest/gtest.h>

#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {
namespace {

HeartbeatSample heartbeat(std::uint64_t beat, std::uint64_t instance) {
  HeartbeatSample sample;
  sample.beat = beat;
  sample.instance_id = instance;
  return sample;
}

TEST(IsOlder, TheOneWithMoreHeartbeatsIs) {
  EXPECT_TRUE(is_older(heartbeat(100, 9), 10, 1));
  EXPECT_FALSE(is_older(heartbeat(10, 1), 100, 9));
}

TEST(IsOlder, OfTwoThatStartTogetherBothComeToTheSameAnswer) {
  for (const std::uint64_t ahead : {0U, 1U, 4U}) {
    EXPECT_TRUE(is_older(heartbeat(10, 1), 10 + ahead, 2));
    EXPECT_FALSE(is_older(heartbeat(10 + ahead, 2), 10, 1));
  }
}

TEST(AgentPresenceTest, BeatsWithItsProgress) {
  const Participant here(loopback("here"));
  const Participant there(loopback("there"));
  InboxOf<HeartbeatSample> inbox(there, topics::kWearableHeartbeat);
  AgentPresence presence(here, topics::kWearableHeartbeat, "wearer");
  AgentProgress progress;
  progress.frames_sent = 7;
  progress.frames.gaps = 2;
  presence.update(progress);
  ASSERT_TRUE(eventually([&] {
    const auto received = inbox.received();
    return !received.empty() && received.back().sample.frames_sent == 7;
  }));
  const HeartbeatSample last = inbox.received().back().sample;
  EXPECT_EQ(last.agent_id, "wearer");
  EXPECT_EQ(last.frames.gaps, 2U);
  EXPECT_GT(last.beat, 0U);
  EXPECT_GT(last.stamp, 0);
}

TEST(AgentPresenceTest, OfTwoAgentsWithOneIdTheLaterOneLearnsThatItHasToGo) {
  const Participant here(loopback("here"));
  const Participant there(loopback("there"));
  InboxOf<HeartbeatSample> inbox(there, topics::kWearableHeartbeat);
  AgentPresence first(here, topics::kWearableHeartbeat, "wearer");
  ASSERT_TRUE(eventually([&] {
    const auto received = inbox.received();
    return !received.empty() && received.back().sample.beat > 6;
  }));
  AgentPresence second(there, topics::kWearableHeartbeat, "wearer");
  EXPECT_TRUE(eventually([&] { return second.has_older_namesake(); }));
  EXPECT_TRUE(eventually([&] { return first.newer_namesakes() == 1; }));
  EXPECT_FALSE(first.has_older_namesake());
}

TEST(AgentPresenceTest, AgentsWithDifferentIdsLeaveEachOtherAlone) {
  const Participant here(loopback("here"));
  const Participant there(loopback("there"));
  InboxOf<HeartbeatSample> inbox(there, topics::kWearableHeartbeat);
  AgentPresence first(here, topics::kWearableHeartbeat, "one");
  AgentPresence second(there, topics::kWearableHeartbeat, "two");
  ASSERT_TRUE(inbox.wait_for(10));
  EXPECT_FALSE(first.has_older_namesake());
  EXPECT_FALSE(second.has_older_namesake());
  EXPECT_EQ(first.newer_namesakes() + second.newer_namesakes(), 0U);
}

}  // namespace
}  // namespace cosight::transport
