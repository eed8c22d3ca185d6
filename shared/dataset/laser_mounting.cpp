#include "shared/dataset/laser_mounting.hpp"

#include "shared/config/calibration.hpp"
#include "shared/config/config.hpp"

namespace cosight {
namespace {

double required(const ConfigNode& node, const char* key, double min, double max) {
  if (!node.has(key)) throw node.error(key, "is missing; a laser can't be read without");
  return node.number(key, min, min, max);
}

LaserMounting read_laser(const ConfigNode& node, const std::string& name) {
  constexpr double kTurn = 6.3;
  constexpr double kFarthest = 1e4;
  LaserMounting laser;
  laser.laser = "laser_" + name;
  laser.points = static_cast<int>(required(node, "points", 1.0, 1e5));
  laser.angle_min = required(node, "angle_min_rad", -kTurn, kTurn);
  laser.angle_increment = required(node, "angle_increment_rad", -kTurn, kTurn);
  laser.range_min = required(node, "range_min_m", 0.0, kFarthest);
  laser.range_max = required(node, "range_max_m", 0.0, kFarthest);
  laser.range_sigma = node.number("range_sigma_m", laser.range_sigma, 1e-5, 10.0);
  if (!node.has("T_BL")) throw node.error("T_BL", "is missing; where does the laser sit in the robot?");
  laser.T_BL = read_transform(node, "T_BL");
  return laser;
}

}  // namespace

std::vector<LaserMounting> read_laser_mountings(const std::filesystem::path& yaml) {
  const ConfigFile file = ConfigFile::load(yaml);
  std::vector<LaserMounting> lasers;
  for (const std::string& name : file.root().keys())
    lasers.push_back(read_laser(file.root().section(name), name));
  if (lasers.empty()) throw ConfigError(yaml.string() + ": names no laser; write a section front");
  file.refuse_unknown_keys();
  return lasers;
}

}  // namespace cosight
