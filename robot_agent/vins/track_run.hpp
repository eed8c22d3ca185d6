#pragma once

#include <atomic>
#include <vector>

#include "robot_agent/vins/track_files.hpp"
#include "robot_agent/vins/window_odometry.hpp"

namespace cosight::vins {

struct TrackRunOptions {
  WindowOptions window;
  ImuNoise noise;
  std::size_t max_frames = 1'000'000;  ///< a shorter run for trials
  /// The first state is the true one, as the peers were started; its biases are zero to within what a
  /// calibration before the drive leaves.
  StartUncertainty start{.position = 1e-3,
                         .yaw = 1e-3,
                         .tilt = 1e-2,
                         .velocity = 0.1,
                         .accelerometer_bias = 0.01,
                         .gyroscope_bias = 1e-3};
};

/// What the paper's Tables 2 and 3 say of one run.
struct TrackMetrics {
  double rpe_mean = 0.0;         ///< over 1 s, poses thinned to 1 Hz, as evo with a delta of one frame [m]
  double rpe_std = 0.0;          ///< [m]
  double rpe_max = 0.0;          ///< [m]
  double rpe_frame_mean = 0.0;   ///< between neighbouring frames [m]
  double drift_percent = 0.0;    ///< V32
  double outlier_percent = 0.0;  ///< features tracked fewer than 10 times, of all features
};

/// A run over a recorded sequence: one report a frame from the second on.
struct TrackRun {
  Trajectory estimate;  ///< T_WB, from the first frame on
  std::vector<WindowReport> reports;
  std::vector<double> rpe;  ///< of each second [m]
  TrackMetrics metrics;
  double solve_ms_median = 0.0;
  double solve_ms_p99 = 0.0;
  double marginalise_ms_median = 0.0;
};

/// Starts from the true first state and goes through the whole sequence. Once `stop`, which may be null, is
/// true, it ends where it is, without metrics.
TrackRun run_tracks(const TrackSequence& sequence, const TrackRunOptions& options,
                    const std::atomic<bool>* stop = nullptr);

}  // namespace cosight::vins
