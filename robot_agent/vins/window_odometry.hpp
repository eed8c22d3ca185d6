#pragma once

#include <optional>

#include "robot_agent/vins/known_distances.hpp"
#include "robot_agent/vins/sliding_window.hpp"

namespace cosight::vins {

/// What one frame did to the window.
struct WindowReport {
  Stamp stamp = 0;
  NavState state = {};      ///< of the newest frame
  NavState predicted = {};  ///< the same by the IMU alone, from the frame before
  SolveReport solve = {};
  bool keyframe = false;  ///< the second newest frame was kept
  double geometry_factor = 0.0;
  double mean_times_tracked = 0.0;  ///< N, over the frame's features
  double typical_misfit = 0.0;      ///< see misfit.hpp [rad]
  bool many_bend = false;           ///< the guarded mode acts; see misfit.hpp
  DistanceCheck distances = {};     ///< against what others know
  int tracked = 0;                  ///< features of this frame that were seen before
  int landmarks_dropped = 0;        ///< came to lie behind their host
  double solve_ms = 0.0;
  double marginalise_ms = 0.0;
};

/// Visual-inertial odometry from a known first state on: V20 / V31 minimised over a sliding window.
class WindowOdometry {
 public:
  WindowOdometry(const WindowOptions& options, const ImuNoise& noise, const Pose& T_BS)
      : options_(options), noise_(noise) {
    window_.T_BS = T_BS;
  }

  /// Starts anew with one frame whose state is known that well.
  void start(const FeatureFrame& frame, const NavState& state, const StartUncertainty& uncertainty);

  /// Starts anew with the frames, landmarks and states of an initialisation. `is_sure`: they can't be quite
  /// wrong, so that the guarded mode need not rest for `settling_time`.
  void start(Window window, bool is_sure = false);

  /// The newest state right after such a start.
  WindowReport report_of_start() const;

  /// The next frame, and all IMU samples from the newest frame's instant to this one's.
  WindowReport process(const FeatureFrame& frame, std::vector<ImuSample> imu);

  const Window& window() const { return window_; }

 private:
  WindowOptions options_;
  ImuNoise noise_;
  Window window_;
  Stamp learned_ = 0;  ///< from then on the usual misfit is known
  Stamp settled_ = 0;  ///< from then on the guarded mode may act
};

}  // namespace cosight::vins
