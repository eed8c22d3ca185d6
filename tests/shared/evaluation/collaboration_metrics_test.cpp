#include "shared/evaluation/collaboration_metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/shared/evaluation/made_trajectory.hpp"

namespace cosight {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

/// One frame a letter at 1 Hz: 'o' overlaps.
std::vector<FrameRecord> frames(const std::string& letters) {
  std::vector<FrameRecord> records;
  for (std::size_t i = 0; i < letters.size(); ++i) {
    FrameRecord record;
    record.stamp = static_cast<Stamp>(i) * kNanosecondsPerSecond;
    record.pseudo_stereo = letters[i] == 'o';
    records.push_back(record);
  }
  return records;
}

TEST(OverlapPeriods, AreTheRunsOfFrames) {
  const OverlapPeriods periods = overlap_periods(frames("oo...o....oooo"));
  EXPECT_THAT(periods.overlaps, ElementsAre(DoubleNear(2, 1e-9), DoubleNear(1, 1e-9), DoubleNear(4, 1e-9)));
  EXPECT_THAT(periods.gaps, ElementsAre(DoubleNear(3, 1e-9), DoubleNear(4, 1e-9)));
  EXPECT_NEAR(overlap_ratio(periods).value(), 0.5, 1e-9);
}

TEST(OverlapPeriods, FollowTheStampsNotTheFrames) {
  std::vector<FrameRecord> records = frames("o..");
  records[1].stamp = 5 * kNanosecondsPerSecond;
  records[2].stamp = 6 * kNanosecondsPerSecond;
  EXPECT_NEAR(overlap_ratio(overlap_periods(records)).value(), 5.0 / 7.0, 1e-9);
}

TEST(OverlapPeriods, GoOnThroughABlink) {
  std::vector<FrameRecord> records = frames("o.oo..o");
  for (std::size_t i = 0; i < records.size(); ++i)
    records[i].stamp = static_cast<Stamp>(i) * kNanosecondsPerSecond / 7;
  const OverlapPeriods periods = overlap_periods(records);
  EXPECT_THAT(periods.overlaps, ElementsAre(DoubleNear(4.0 / 7, 1e-9), DoubleNear(1.0 / 7, 1e-9)));
  EXPECT_THAT(periods.gaps, ElementsAre(DoubleNear(2.0 / 7, 1e-9)));
}

TEST(Tau, IsThePapersAsPrinted) {
  // eta = 2, 1, 4: mean 7/3, deviations 1/3 + 4/3 + 5/3 = 10/3, times N = 3.
  EXPECT_NEAR(overlap_irregularity(overlap_periods(frames("oo...o....oooo"))).value(), 10.0, 1e-9);
  EXPECT_NEAR(overlap_irregularity(overlap_periods(frames("oo..oo"))).value(), 0.0, 1e-9);
}

TEST(Kappa, IsTheVarianceOfTheGaps) {
  EXPECT_NEAR(gap_deviation(overlap_periods(frames("oo...o....oooo"))).value(), 0.25, 1e-9);
}

TEST(CollaborationMetrics, AreUndefinedForASinglePeriod) {
  EXPECT_FALSE(overlap_irregularity(overlap_periods(frames("..oo.."))).has_value());
  EXPECT_FALSE(gap_deviation(overlap_periods(frames("oo..oo"))).has_value());
  EXPECT_FALSE(overlap_ratio(overlap_periods(frames("o"))).has_value());
  EXPECT_FALSE(overlap_ratio(overlap_periods({})).has_value());
}

TEST(OverlapCost, IsThePapersU) {
  const Trajectory truth = straight_line(6, 2.0);  // 10 m from end to end
  const auto pairs = pairs_of(mapped(truth, 1.0, {Eigen::Quaterniond::Identity(), {0, 0.5, 0}}), truth);
  // 3 s of overlap, six squared errors of 0.25 m^2.
  EXPECT_NEAR(overlap_cost(overlap_periods(frames("ooo...")), pairs).value(), 3.0 / 10.0 * 1.5, 1e-9);
}

TEST(OverlapCost, IsUndefinedWhereTheTruthEndsWhereItBegan) {
  const auto pairs = pairs_of(straight_line(3, 0.0), straight_line(3, 0.0));
  EXPECT_FALSE(overlap_cost(overlap_periods(frames("ooo")), pairs).has_value());
  EXPECT_FALSE(overlap_cost(overlap_periods(frames("ooo")), {}).has_value());
}

}  // namespace
}  // namespace cosight
