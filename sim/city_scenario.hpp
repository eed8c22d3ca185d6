#pragma once

#include <string>

#include "shared/config/config.hpp"
#include "sim/carrier.hpp"
#include "sim/city/route.hpp"
#include "sim/city/traffic.hpp"
#include "sim/sensors/imu.hpp"
#include "sim/world/city.hpp"

namespace cosight::sim {

/// A car with a camera and an IMU, alone in a city's traffic.
struct CityScenario {
  std::string name = "city";
  double length = 1190.0;  ///< of the way [m]
  RouteOptions route{.start_speed = 0.0, .hills = 0.0};
  TrafficOptions traffic{.continuous = true};
  CityPlan city;
  CameraPlan camera;
  ImuPlan imu;
};

/// Whether a scene file is one of a city: it has a section `city`.
bool is_city(const ConfigNode& root);

/// Reads a scene file as config/scenes/urban_canyon_1.yaml. Throws ConfigError.
CityScenario read_city_scenario(const ConfigNode& root);

}  // namespace cosight::sim
