#pragma once

#include <optional>
#include <vector>

#include "robot_agent/vins/gyroscope_bias.hpp"
#include "robot_agent/vins/rest.hpp"
#include "robot_agent/vins/sliding_window.hpp"

namespace cosight::vins {

/// Whether a window could be started, or why not yet.
enum class InitialisationOutcome {
  kReady,
  kTooFewFrames,       ///< the window is not full, or spans too little time
  kTooFewTracks,       ///< not enough features are seen in several of its frames
  kTooLittleParallax,  ///< the features hardly move once the turn is taken out: at rest, or only turning
  kNoSolution,         ///< the equations of bias, velocity or gravity have none
  kScaleUnobservable,  ///< the accelerations do not tell the scale well enough: constant velocity
  kInconsistent,       ///< camera and IMU contradict each other more than their noise allows
};
const char* to_string(InitialisationOutcome outcome);

struct InitialisationOptions {
  std::size_t frames = 11;
  double min_span = 0.8;              ///< [s] from the first to the last frame
  std::size_t min_tracks = 25;        ///< seen in both the first third and the last third
  double min_parallax = 6.0 / 460.0;  ///< median, without the turn [rad]
  double max_scale_deviation = 0.3;   ///< standard deviation of the scale
  double max_misfit = 3.0 / 460.0;    ///< typical misfit after the solution [rad]
  int max_iterations = 30;
  RestOptions rest;
  StartUncertainty prior{.tilt = 0.2, .velocity = 2.0, .accelerometer_bias = 0.1, .gyroscope_bias = 0.05};
};

struct Initialisation {
  InitialisationOutcome outcome = InitialisationOutcome::kTooFewFrames;
  double scale_deviation = 0.0;                 ///< relative, where it got that far
  double typical_misfit = 0.0;                  ///< [rad], likewise
  std::optional<Window> window = std::nullopt;  ///< set when ready
};

/// States for a few frames from nothing but their features and the IMU between them: gyroscope bias from the
/// rotations, then velocity, gravity and scale, then everything by the window's own least squares with a wide
/// prior. W has its origin in the first frame, z up, and that frame's x axis as its heading. `rest`: of the
/// first frame, if it was at rest; then its velocity, gravity and biases are known.
Initialisation initialise(const std::vector<UnplacedFrame>& frames, const Pose& T_BS,
                          const InitialisationOptions& options, const WindowOptions& window,
                          const std::optional<Rest>& rest = std::nullopt);

/// Median angle between bearings of the first and the last frame that see a feature, without the turn [rad].
double median_parallax(const std::vector<UnplacedFrame>& frames, const Pose& T_BS);

}  // namespace cosight::vins
