#pragma once

#include "experiments/urban_canyon/front_end.hpp"
#include "robot_agent/vins/track_files.hpp"

namespace cosight::experiments {

/// An urban canyon as the paper's section 5 has them.
struct CanyonOptions {
  double length = 1190.0;  ///< [m]
  TrafficOptions traffic;
  FrontEndOptions front_end;
  /// An MTi-10 by its data sheet, as densities; its biases walk slowly.
  vins::ImuNoise imu{
      .accelerometer = 7.8e-4, .gyroscope = 5.2e-4, .accelerometer_walk = 1e-4, .gyroscope_walk = 1e-5};
  double calibrated_noise = 0.3;           ///< what the window takes for the pixels' noise [px]
  double start_accelerometer_bias = 0.01;  ///< what calibration left [m/s^2]
  double start_gyroscope_bias = 1e-3;      ///< likewise [rad/s]
};

/// 1.19 km by day, little traffic: 8.6 % of the sightings on vehicles.
CanyonOptions urban_canyon_1();
/// 1.98 km at night, dense traffic: 19.6 %.
CanyonOptions urban_canyon_2();

/// A drive through a canyon: what the window is given, and what only the generator knows.
struct CanyonDrive {
  vins::TrackSequence sequence;
  double moving_percent = 0.0;                ///< share of the sightings that are on vehicles
  std::set<vins::FeatureId> moving;           ///< the features on vehicles
  std::vector<Eigen::Vector3d> velocities_W;  ///< true, one for each frame [m/s]
};

/// The same drive as a front end that knows every vehicle would give it.
vins::TrackSequence without_vehicles(const CanyonDrive& drive);

/// The same seed gives the same drive. IMU 200 Hz, camera 10 Hz.
CanyonDrive make_canyon_drive(const CanyonOptions& options, unsigned seed);

}  // namespace cosight::experiments
