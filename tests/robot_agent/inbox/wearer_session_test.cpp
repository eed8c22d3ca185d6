#include "robot_agent/inbox/wearer_session.hpp"

#include <gtest/gtest.h>

#include "robot_agent/inbox/options.hpp"

namespace cosight::inbox {
namespace {

constexpr Stamp ms(std::int64_t milliseconds) {
  return from_milliseconds(milliseconds);
}
constexpr PeerId kFirst{1};
constexpr PeerId kSecond{2};

TEST(WearerSession, RefusesASecondWearerWhileTheFirstLives) {
  WearerSession session(ms(500));
  EXPECT_EQ(session.admit(kFirst, ms(0)), Admission::kAccepted);
  EXPECT_EQ(session.admit(kSecond, ms(100)), Admission::kRefused);
  EXPECT_EQ(session.admit(kFirst, ms(400)), Admission::kAccepted);
  EXPECT_EQ(session.admit(kSecond, ms(800)), Admission::kRefused);
}

TEST(WearerSession, AcceptsARestartOnceTheOldProcessIsSilent) {
  WearerSession session(ms(500));
  session.admit(kFirst, ms(0));
  EXPECT_EQ(session.admit(kSecond, ms(499)), Admission::kRefused);
  EXPECT_EQ(session.admit(kSecond, ms(500)), Admission::kRestarted);
  EXPECT_EQ(session.admit(kSecond, ms(501)), Admission::kAccepted);
  EXPECT_EQ(session.admit(kFirst, ms(502)), Admission::kRefused);
}

TEST(WearerSession, AcceptsARestartAtOnceWhenTheOldProcessIsGone) {
  WearerSession session(ms(500));
  session.admit(kFirst, ms(0));
  EXPECT_FALSE(session.gone(kSecond));
  EXPECT_EQ(session.admit(kSecond, ms(1)), Admission::kRefused);
  EXPECT_TRUE(session.gone(kFirst));
  EXPECT_EQ(session.admit(kSecond, ms(2)), Admission::kRestarted);
}

TEST(WearerSession, TheSameProcessMayFallSilentAndGoOn) {
  WearerSession session(ms(500));
  session.admit(kFirst, ms(0));
  session.gone(kFirst);
  EXPECT_EQ(session.admit(kFirst, ms(5'000)), Admission::kAccepted);
  EXPECT_EQ(session.admit(kSecond, ms(5'001)), Admission::kRefused);
}

}  // namespace
}  // namespace cosight::inbox
