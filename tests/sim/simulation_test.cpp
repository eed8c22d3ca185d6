#include "sim/simulation.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/dataset/cosight_dataset.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;

/// Half a second in a small room, small pictures.
Scenario short_walk() {
  Scenario scenario;
  scenario.plan.outlines.push_back({{{-1, -2}, {5, -2}, {5, 2}, {-1, 2}}, Material::kPlaster, 1.0});
  scenario.plan.texel = 0.01;
  scenario.path.waypoints = {{0, 0}, {2, 0}};
  scenario.duration = 0.5;
  scenario.wearer.ahead = {{0.0, -0.6}};
  scenario.wearer.left = {{0.0, 0.6}};
  for (CameraPlan* camera : {&scenario.robot_camera, &scenario.wearer_camera}) {
    camera->lens = {.fx = 140, .fy = 140, .cx = 99.5, .cy = 74.5, .width = 200, .height = 150};
    camera->lens.distortion = Distortion::kRadtan;
    camera->lens.coefficients = {-0.1, 0.02, 0.0, 0.0, 0.0};
  }
  scenario.robot_camera.T_BC = optical_mount({0.1, 0, 0.9}, 0.0, 0.0);
  scenario.wearer_camera.T_BC = optical_mount({0.1, 0, 0.0}, 0.0, -0.1);
  return scenario;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ostringstream bytes;
    bytes << std::ifstream(entry.path(), std::ios::binary).rdbuf();
    files[fs::relative(entry.path(), folder).string()] = bytes.str();
  }
  return files;
}

class WriteDataset : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove_all(root_); }

  fs::path run(const std::string& name, const RunOptions& options) {
    report_ = write_dataset(short_walk(), options, root_ / name, stop_);
    return root_ / name;
  }

  std::atomic<bool> stop_{false};
  RunReport report_;
  fs::path root_ =
      fs::path(::testing::TempDir()) /
      (std::string("cosight_sim_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(WriteDataset, GivesTheSameBytesFromTheSameSeedWithAnyNumberOfThreads) {
  const auto alone = files_in(run("alone", {.seed = 5, .threads = 1}));
  const auto many = files_in(run("many", {.seed = 5, .threads = 3}));
  const auto other = files_in(run("other", {.seed = 6, .threads = 1}));
  EXPECT_GT(alone.size(), 20U);
  EXPECT_TRUE(alone == many);
  EXPECT_NE(alone.at("robot/cam0/000002.jpg"), other.at("robot/cam0/000002.jpg"));
  EXPECT_NE(alone.at("robot/imu.csv"), other.at("robot/imu.csv"));
}

TEST_F(WriteDataset, IsReadAsADatasetFolder) {
  const CosightDataset dataset(run("walk", {.seed = 1}));
  EXPECT_TRUE(dataset.has_wearer());
  EXPECT_EQ(dataset.robot_camera().width, 200);
  const auto robot = dataset.open_robot();
  int frames = 0;
  int poses = 0;
  while (const auto sample = robot->next()) {
    frames += std::holds_alternative<ImageSample>(*sample) ? 1 : 0;
    poses += std::holds_alternative<WearerPoseSample>(*sample) ? 1 : 0;
  }
  EXPECT_EQ(frames, 6);
  EXPECT_EQ(poses, 6);
  const auto wearer = dataset.open_wearer();
  int orientations = 0;
  while (const auto sample = wearer->next())
    orientations += std::holds_alternative<AhrsSample>(*sample) ? 1 : 0;
  EXPECT_EQ(orientations, 51);
  EXPECT_EQ(wearer->counters().unreadable, 0U);
}

TEST_F(WriteDataset, SurveysPointsThatTheFirstTruePoseProjectsToTheirPixels) {
  const fs::path folder = run("walk", {.seed = 1});
  const CosightDataset dataset(folder);
  std::ifstream truth(dataset.robot_truth());
  double stamp = 0.0;
  Pose T_WS;
  truth >> stamp >> T_WS.p.x() >> T_WS.p.y() >> T_WS.p.z() >> T_WS.q.x() >> T_WS.q.y() >> T_WS.q.z() >>
      T_WS.q.w();
  const CameraModel camera = dataset.robot_camera();
  const auto points = dataset.known_points();
  ASSERT_GE(points.size(), 6U);
  EXPECT_EQ(points.size(), report_.known_points);
  for (const KnownPoint& point : points) {
    const auto pixel = camera.project(T_WS.inverse() * point.p_W);
    ASSERT_TRUE(pixel && point.pixel);
    EXPECT_LT((*pixel - *point.pixel).norm(), 1e-3);
  }
}

TEST_F(WriteDataset, LeavesNoSurveyOfAnEarlierRun) {
  const fs::path folder = run("walk", {.seed = 1, .with_frames = false});
  EXPECT_TRUE(fs::exists(folder / "robot/known_points.csv"));
  Scenario scenario = short_walk();
  scenario.known_points = 0;
  write_dataset(scenario, {.seed = 1, .with_frames = false}, folder, stop_);
  EXPECT_FALSE(fs::exists(folder / "robot/known_points.csv"));
}

TEST_F(WriteDataset, KeepsTheMountingOfTheCamera) {
  const fs::path folder = run("walk", {.seed = 1, .with_frames = false});
  const auto T_BC = load_body_extrinsics(folder / "robot/calibration.yaml");
  ASSERT_TRUE(T_BC);
  EXPECT_NEAR((T_BC->p - Eigen::Vector3d(0.1, 0, 0.9)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((T_BC->q * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(), 0.0, 1e-9);
}

TEST_F(WriteDataset, MeetsTheWantedOverlapRatio) {
  Scenario scenario = short_walk();
  scenario.plan.outlines[0].corners = {{-1, -2}, {12, -2}, {12, 2}, {-1, 2}};
  scenario.plan.texel = 0.05;
  scenario.path.waypoints = {{0, 0}, {8, 0}};
  scenario.duration = 0.0;
  scenario.gaze = {.ratio = 0.4, .intervals = 3, .aside = 2.0, .turn_time = 0.6};
  const RunReport report =
      write_dataset(scenario, {.seed = 2, .with_frames = false}, root_ / "overlap", stop_);
  EXPECT_NEAR(report.overlap_ratio, 0.4, 0.03);
}

TEST_F(WriteDataset, StopsWhenItIsAskedTo) {
  stop_ = true;
  run("stopped", {.seed = 1});
  EXPECT_TRUE(report_.stopped);
  EXPECT_TRUE(fs::is_empty(root_ / "stopped/robot/cam0"));
}

}  // namespace
}  // namespace cosight::sim
