#pragma once

#include <filesystem>
#include <string>

#include "shared/config/config.hpp"

namespace cosight::wearer {

/// Where and when an AHRS points to the magnetic north, and which model of the earth's field tells where that
/// is.
struct MagneticPlace {
  std::filesystem::path folder;  ///< with NAME.wmm and NAME.wmm.cof
  std::string name = "wmm2020";
  double latitude = 0.0, longitude = 0.0;  ///< [degrees]
  double height = 0.0;                     ///< above the ellipsoid [m]
  double year = 2025.0;                    ///< with its fraction
};

/// How far east of the true north the magnetic north lies [rad]. Throws GeographicLib's GeographicErr when
/// the model cannot be read.
double declination(const MagneticPlace& place);

/// `declination_deg`, or from a model with `magnetic_model_folder` (and `magnetic_model`, `latitude_deg`,
/// `longitude_deg`, `height_m`, `year`); 0 without any of them [rad]. A direction at the angle yaw to the
/// left of the magnetic north is yaw - declination to the left of the true north. Throws ConfigError.
double read_declination(const ConfigNode& node);

}  // namespace cosight::wearer
