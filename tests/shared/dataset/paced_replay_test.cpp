#include "shared/dataset/paced_replay.hpp"

#include <gmock/gmock.h>

#include "shared/dataset/merged_source.hpp"
#include "tests/shared/dataset/memory_source.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;

/// Time passes only where the replay sleeps, or where the test says so.
class ManualClock : public PacingClock {
 public:
  Stamp now() const override { return now_; }
  void sleep_until(Stamp due, const std::atomic<bool>& /*stop*/) override {
    if (due > now_) now_ = due;
  }
  void pass(Stamp duration) { now_ += duration; }

 private:
  Stamp now_ = 1'000'000;
};

class PacedReplayTest : public testing::Test {
 protected:
  /// When each sample comes out, from the first one's time.
  std::vector<Stamp> times_of(PacedReplay& replay, int count) {
    std::vector<Stamp> times;
    for (int i = 0; i < count && replay.next(); ++i)
      times.push_back(clock_.now() - 1'000'000);
    return times;
  }

  std::atomic<bool> stop_ = false;
  ManualClock clock_;
};

TEST_F(PacedReplayTest, KeepsTheRhythmOfTheStamps) {
  PacedReplay replay([] { return images({700, 710, 750}); }, {}, clock_, stop_);
  EXPECT_THAT(times_of(replay, 9), ElementsAre(0, 10, 50));
}

TEST_F(PacedReplayTest, RateStretchesTheRhythm) {
  PacedReplay replay([] { return images({700, 710, 750}); }, {.rate = 2.0}, clock_, stop_);
  EXPECT_THAT(times_of(replay, 9), ElementsAre(0, 5, 25));
}

TEST_F(PacedReplayTest, RateZeroNeverWaits) {
  PacedReplay replay([] { return images({700, 710, 750}); }, {.rate = 0.0}, clock_, stop_);
  EXPECT_THAT(times_of(replay, 9), ElementsAre(0, 0, 0));
}

TEST_F(PacedReplayTest, CatchesUpAfterADelayWithoutDropping) {
  PacedReplay replay([] { return images({0, 10, 20, 30, 40}); }, {}, clock_, stop_);
  EXPECT_THAT(times_of(replay, 2), ElementsAre(0, 10));
  clock_.pass(17);
  EXPECT_THAT(times_of(replay, 9), ElementsAre(27, 30, 40));
}

TEST_F(PacedReplayTest, ALoopGoesOnForward) {
  const auto open = [] {
    std::vector<std::unique_ptr<SampleSource>> sources;
    sources.push_back(orientations({95, 105, 115}));
    sources.push_back(images({100, 110, 120}));
    return std::make_unique<MergedSource>(std::move(sources));
  };
  PacedReplay replay(open, {.loop = true}, clock_, stop_);
  std::vector<Sample> samples;
  for (int i = 0; i < 13; ++i)
    samples.push_back(*replay.next());
  EXPECT_THAT(stamps_of(samples),
              ElementsAre(95, 100, 105, 110, 115, 120, 130, 135, 140, 145, 150, 155, 165));
  EXPECT_THAT(sequences_of(samples), ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_EQ(clock_.now() - 1'000'000, 165 - 95);
  EXPECT_EQ(replay.counters(SampleKind::kImage).delivered, 6U);
  EXPECT_EQ(replay.counters().delivered, 13U);
}

TEST_F(PacedReplayTest, ALoopOfOneImageStillGoesForward) {
  PacedReplay replay([] { return images({100}); }, {.loop = true}, clock_, stop_);
  std::vector<Sample> samples;
  for (int i = 0; i < 3; ++i)
    samples.push_back(*replay.next());
  const auto stamps = stamps_of(samples);
  EXPECT_LT(stamps[0], stamps[1]);
  EXPECT_LT(stamps[1], stamps[2]);
}

TEST_F(PacedReplayTest, ALoopOverNothingEnds) {
  PacedReplay replay([] { return images({}); }, {.loop = true}, clock_, stop_);
  EXPECT_FALSE(replay.next());
}

TEST_F(PacedReplayTest, ALoopWhoseInputIsTakenAwayEnds) {
  int laps = 0;
  PacedReplay replay(
      [&] {
        if (++laps > 1) throw DatasetError("gone");
        return images({1, 2});
      },
      {.loop = true}, clock_, stop_);
  EXPECT_EQ(times_of(replay, 9).size(), 2U);
  EXPECT_FALSE(replay.next());
  EXPECT_EQ(replay.counters().delivered, 2U);
}

TEST_F(PacedReplayTest, StopEndsIt) {
  PacedReplay replay([] { return images({0, 10, 20}); }, {}, clock_, stop_);
  EXPECT_TRUE(replay.next());
  stop_ = true;
  EXPECT_FALSE(replay.next());
}

TEST(SteadyClock, StopWakesASleeper) {
  SteadyClock clock;
  const std::atomic<bool> stop = true;
  clock.sleep_until(clock.now() + 3'600 * kNanosecondsPerSecond, stop);
  SUCCEED();
}

}  // namespace
}  // namespace cosight
