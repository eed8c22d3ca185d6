#pragma once

#include <filesystem>
#include <vector>

#include "robot_agent/vins/feature_tracker.hpp"
#include "robot_agent/vins/imu.hpp"

namespace cosight::vins {

/// The folder of euroc_v101_flight, in $COSIGHT_DATA or beside the sources; it may not be there.
std::filesystem::path flight();

/// Its 200 Hz IMU.
std::vector<ImuSample> flight_imu();

/// What its calibration says of the IMU's noise.
ImuNoise flight_noise();

/// The features of its images, followed by `tracker`.
std::vector<FeatureFrame> flight_features(FeatureTracker& tracker);

}  // namespace cosight::vins
