#pragma once

#include "robot_agent/vins/calibration_prior.hpp"
#include "robot_agent/vins/keyframe.hpp"
#include "robot_agent/vins/window_solver.hpp"

namespace cosight::vins {

struct WindowOptions {
  std::size_t size = 11;  ///< frames, the newest included (Table 1: n)
  /// Inverse distance below minus this: behind the camera. Noise makes that of far points negative as often
  /// as positive, and dropping those would bias the scale [1/m].
  double max_behind = 0.02;
  double default_distance = 5.0;          ///< of a landmark that cannot be triangulated yet [m]
  double max_gyroscope_change = 0.1;      ///< bias change that makes the IMU be integrated again [rad/s]
  double max_accelerometer_change = 0.1;  ///< likewise [m/s^2]
  CalibrationUncertainty calibration;     ///< where the calibration is refined
  /// After a start from nothing, in motion, the guarded mode rests so long: from a wrong state it is the
  /// static features that bend, and they have to put it right [s].
  double settling_time = 30.0;
  /// After any start from nothing it rests so long at least, until it has learned what misfit is usual [s].
  double learning_time = 10.0;
  KeyframeOptions keyframe;
  SolverOptions solver;
};

/// How well the first state is known: standard deviations.
struct StartUncertainty {
  double position = 1e-3;            ///< [m]; the origin is a convention, so small
  double yaw = 1e-3;                 ///< [rad]; likewise
  double tilt = 0.02;                ///< roll and pitch [rad]
  double velocity = 0.1;             ///< [m/s]
  double accelerometer_bias = 0.05;  ///< [m/s^2]
  double gyroscope_bias = 0.005;     ///< [rad/s]
};

/// The prior that a known first state is.
Prior start_prior(const WindowFrame& first, const StartUncertainty& uncertainty);

/// Adds a frame that continues the newest one by `imu`; its state is predicted by the IMU.
void append_frame(Window& window, const FeatureFrame& frame, Preintegration imu, double gravity);

/// Geometry factor of each frame from the landmarks it saw and that have a depth (V22-V25).
void update_geometry_factors(Window& window);

/// Takes out landmarks that came to lie behind their host; a feature that is still tracked starts anew with
/// its newest sighting. Returns how many.
int drop_failed_landmarks(Window& window, const WindowOptions& options);

/// One frame less: the oldest, when the second newest is a keyframe or must stay; otherwise the second
/// newest.
void slide(Window& window, bool second_newest_is_keyframe, const WindowOptions& options);

/// Integrates again where the biases have moved too far for the first-order correction.
void repropagate_where_needed(Window& window, const WindowOptions& options);

}  // namespace cosight::vins
