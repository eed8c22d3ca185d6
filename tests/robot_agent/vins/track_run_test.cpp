#include "robot_agent/vins/track_run.hpp"

#include <gtest/gtest.h>

#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

/// Three seconds of a drive at 10 Hz, with its truth.
TrackSequence short_sequence() {
  SyntheticDrive drive(8);
  TrackSequence sequence;
  for (int i = 0; i <= 30; ++i) {
    sequence.frames.push_back(drive.camera(0.1 * i, 0.25));
    sequence.truth.push_back({drive.stamp(0.1 * i), drive.state(0.1 * i).T_WB});
  }
  sequence.imu = drive.imu(0.0, 3.0);
  sequence.T_BS = drive.T_BS();
  return sequence;
}

TrackRunOptions quarter_pixel() {
  TrackRunOptions options;
  options.window.solver.graph.trust.pixel_noise = 0.25;
  return options;
}

TEST(TrackRun, GoesThroughTheWholeSequence) {
  const TrackSequence sequence = short_sequence();
  const TrackRun run = run_tracks(sequence, quarter_pixel());
  ASSERT_EQ(run.estimate.size(), sequence.truth.size());
  EXPECT_EQ(run.reports.size() + 1, run.estimate.size());
  EXPECT_LT((run.estimate.back().T_WC.p - sequence.truth.back().T_WC.p).norm(), 0.1);
  EXPECT_GT(run.metrics.rpe_mean, 0.0);
}

TEST(TrackRun, EndsWhereItIsOnceItIsStopped) {
  const std::atomic<bool> stop = true;
  const TrackRun run = run_tracks(short_sequence(), quarter_pixel(), &stop);
  EXPECT_EQ(run.estimate.size(), 1U);
  EXPECT_TRUE(run.reports.empty());
}

TEST(TrackRun, StopsForNobodyWhileNobodyAsks) {
  const std::atomic<bool> stop = false;
  EXPECT_EQ(run_tracks(short_sequence(), quarter_pixel(), &stop).estimate.size(), 31U);
}

}  // namespace
}  // namespace cosight::vins
