#include "sim/scenario_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "sim/city_scenario.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;

const char* const kSmallest = R"(
world: {outlines: [{corners_m: [[0, 0], [4, 0], [4, 3], [0, 3]]}]}
robot: {path: {waypoints_m: [[1, 1], [3, 1]]}}
)";

TEST(ReadScenario, UnderstandsEverySceneOfTheProject) {
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(fs::path(COSIGHT_SOURCE_DIR) / "config/scenes")) {
    if (file.path().extension() != ".yaml") continue;
    const ConfigFile config = ConfigFile::load(file.path());
    const bool city = is_city(config.root());
    const std::string name =
        city ? read_city_scenario(config.root()).name : read_scenario(config.root()).name;
    EXPECT_NO_THROW(config.refuse_unknown_keys()) << file.path();
    EXPECT_EQ(name, file.path().stem().string());
    ++scenes;
  }
  EXPECT_GE(scenes, 9);
}

TEST(ReadScenario, NeedsNoMoreThanWallsAndAWay) {
  const Scenario scenario = read_scenario(ConfigFile::parse(kSmallest, "smallest").root());
  EXPECT_EQ(scenario.robot_camera.lens.width, 640);
  EXPECT_EQ(scenario.front_laser.points, 133);
  // The optical axis of a camera without angles points forward.
  EXPECT_NEAR((scenario.robot_camera.T_BC.q * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(),
              0.0, 1e-12);
}

TEST(ReadScenario, TurnsTheCameraToTheLeftAndUp) {
  const ConfigFile file =
      ConfigFile::parse(std::string(kSmallest) + "wearer: {camera: {left_deg: 90}}", "turned");
  const Eigen::Vector3d axis = read_scenario(file.root()).wearer_camera.T_BC.q * Eigen::Vector3d::UnitZ();
  EXPECT_NEAR((axis - Eigen::Vector3d::UnitY()).norm(), 0.0, 1e-12);
  const ConfigFile up = ConfigFile::parse(std::string(kSmallest) + "wearer: {camera: {up_deg: 30}}", "up");
  EXPECT_NEAR((read_scenario(up.root()).wearer_camera.T_BC.q * Eigen::Vector3d::UnitZ()).z(), 0.5, 1e-12);
}

TEST(ReadScenario, SaysWhereItIsWrong) {
  const auto message_of = [](const std::string& yaml) -> std::string {
    try {
      const ConfigFile file = ConfigFile::parse(yaml, "scene.yaml");
      read_scenario(file.root());
      file.refuse_unknown_keys();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message_of("robot: {}").find("world.outlines"), std::string::npos);
  EXPECT_NE(message_of(std::string(kSmallest) + "wearer: {ahead_m: [[0, 1], [0, 2]]}").find("wearer.ahead_m"),
            std::string::npos);
  EXPECT_NE(message_of(std::string(kSmallest) + "weather: rain").find("scene.yaml:4"), std::string::npos);
}

}  // namespace
}  // namespace cosight::sim
