#include "sim/sensors/sensor_clock.hpp"

#include <gtest/gtest.h>

namespace cosight::sim {
namespace {

TEST(Ticks, ComeAtTheirRateOnAPerfectClock) {
  const std::vector<Tick> all = ticks({.rate = 25.0}, 2.0, RandomStream(1, "test"));
  ASSERT_EQ(all.size(), 51U);
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_EQ(all[k].stamp, kStartStamp + static_cast<Stamp>(k) * 40'000'000);
    EXPECT_NEAR(all[k].time, 0.04 * static_cast<double>(k), 1e-12);
  }
}

TEST(Ticks, AreStampedLateByTheLatencyAndTheClock) {
  const TimingPlan plan{.rate = 10.0, .latency = 0.03, .clock_offset = -0.5, .clock_drift = 1e-3};
  const Tick last = ticks(plan, 10.0, RandomStream(1, "test")).back();
  EXPECT_NEAR(to_seconds(last.stamp - kStartStamp), 10.0 + 0.03 - 0.5 + 0.01, 1e-8);
  EXPECT_NEAR(last.time, 10.0, 1e-9);
}

TEST(Ticks, AreLostInTheShareThatIsSaid) {
  const auto all = ticks({.rate = 100.0, .drop_out = 0.2}, 100.0, RandomStream(1, "test"));
  EXPECT_NEAR(static_cast<double>(all.size()), 8000.0, 150.0);
}

TEST(Ticks, NeverGoBack) {
  const auto all = ticks({.rate = 100.0, .jitter = 0.05}, 20.0, RandomStream(1, "test"));
  for (std::size_t k = 1; k < all.size(); ++k)
    ASSERT_LT(all[k - 1].stamp, all[k].stamp);
}

}  // namespace
}  // namespace cosight::sim
