#include "tests/robot_agent/vins/flight_data.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "shared/image/image_codec.hpp"

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

std::vector<FeatureFrame> flight_features(FeatureTracker& tracker) {
  std::ifstream stream(flight() / "cam0.csv");
  std::vector<FeatureFrame> frames;
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream fields(line);
    int index = 0;
    Stamp stamp = 0;
    std::string name;
    fields >> index >> stamp >> name;
    frames.push_back(tracker.track(stamp, read_image(flight() / "cam0" / name)));
  }
  return frames;
}

}  // namespace cosight::vins
