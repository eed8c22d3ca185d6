#include "tests/robot_agent/vins/flight_data.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace cosight::vins {

std::filesystem::path flight() {
  const char* const given = std::getenv("COSIGHT_DATA");
  const std::filesystem::path data =
      given != nullptr ? given : std::filesystem::path(COSIGHT_SOURCE_DIR) / "../shared/data";
  return data / "euroc_v101_flight";
}

std::vector<ImuSample> flight_imu() {
  std::ifstream stream(flight() / "imu.csv");
  std::vector<ImuSample> samples;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    ImuSample sample;
    fields >> sample.stamp;
    for (int i = 0; i < 3; ++i)
      fields >> sample.angular_velocity_B(i);
    for (int i = 0; i < 3; ++i)
      fields >> sample.acceleration_B(i);
    samples.push_back(sample);
  }
  return samples;
}

ImuNoise flight_noise() {
  return {.accelerometer = 2.0e-3,
          .gyroscope = 1.6968e-4,
          .accelerometer_walk = 3.0e-3,
          .gyroscope_walk = 1.9393e-5};
}

}  // namespace cosight::vins
