#include "shared/dataset/agent_input.hpp"

#include <gmock/gmock.h>

#include "shared/config/calibration.hpp"
#include "shared/dataset/cosight_dataset.hpp"
#include "tests/shared/dataset/dataset_fixture.hpp"

namespace cosight {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class AgentInputTest : public DatasetFixture {
 protected:
  /// A dataset folder with three frames an agent.
  void make_dataset() const {
    for (const std::string agent : {"robot", "wearer"}) {
      std::string csv = "stamp_ns,file\n";
      for (int i = 0; i < 3; ++i) {
        const std::string name = "cam0/" + std::to_string(i) + ".jpg";
        write_frame(agent + "/" + name, 50 * i);
        csv += std::to_string(kNanosecondsPerSecond * i) + "," + name + "\n";
      }
      write(agent + "/cam0.csv", csv);
      CameraModel camera;
      camera.width = 32;
      camera.height = 24;
      write_camera_model(folder_ / agent / "calibration.yaml", camera);
    }
    write("robot/wearer_pose.csv",
          "stamp_ns,px,py,pz,qx,qy,qz,qw\n0,1,0,0,0,0,0,1\n1000000000,1,0,0,0,0,0,1\n");
    write("robot/known_points.csv", "px,py,pz,u,v\n1,2,3,4,5\n");
    write("wearer/ahrs.csv", "stamp_ns,qx,qy,qz,qw\n5,0,0,0,1\n");
  }

  /// What a robot has besides its camera.
  void add_robot_sensors() const {
    write("robot/lasers.yaml",
          "rear: {points: 2, angle_min_rad: -1, angle_increment_rad: 2, range_min_m: 0.3, range_max_m: 20,\n"
          "       T_BL: [-1, 0, 0, -0.4, 0, -1, 0, 0, 0, 0, 1, 0.3]}\n");
    write("robot/laser_rear.csv", "stamp_ns,a,b\n3,1,inf\n1000000000,1,inf\n");
    write("robot/odometry.csv", "stamp_ns,x_m,y_m,yaw_rad,speed_mps,turn_rate_radps\n3,0,0,0,0,0\n");
    write("robot/imu.csv", "stamp_ns,wx,wy,wz,ax,ay,az\n4,0,0,0,0,0,9.81\n");
  }

  InputOptions options(const std::vector<ConfigOverride>& overrides, Agent agent = Agent::kWearer) const {
    const ConfigFile file = ConfigFile::parse("", "test.yaml", overrides);
    InputOptions read = read_input_options(file.root().section("input"), agent);
    file.refuse_unknown_keys();
    return read;
  }

  std::string error_with(const std::vector<ConfigOverride>& overrides) const {
    return error_of<std::runtime_error>([&] { prepare_input(options(overrides), Agent::kWearer, stop_); });
  }

  ConfigOverride set(const std::string& key, const std::string& value) const {
    return {"input." + key, value, "--" + key, true};
  }

  std::atomic<bool> stop_ = false;
};

TEST_F(AgentInputTest, ADatasetServesBothAgents) {
  make_dataset();
  const auto robot = prepare_input(options({set("dataset", folder_.string())}), Agent::kRobot, stop_);
  EXPECT_EQ(robot.camera.width, 32);
  EXPECT_EQ(robot.known_points.size(), 1U);
  EXPECT_FALSE(robot.live);
  const auto samples = all_of(*robot.open());
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_EQ(kind_of(samples[0]), SampleKind::kWearerPose)
      << "a pose comes before the frame that it belongs to";
  EXPECT_EQ(kind_of(samples[1]), SampleKind::kImage);
  const auto wearer = prepare_input(options({set("dataset", folder_.string()), set("gate", "0:1,2:3")}),
                                    Agent::kWearer, stop_);
  EXPECT_THAT(stamps_of(all_of(*wearer.open())), ElementsAre(0, 5, 2 * kNanosecondsPerSecond));
}

TEST_F(AgentInputTest, ADatasetWithLasersYieldsEverythingInTheOrderOfTheStamps) {
  make_dataset();
  add_robot_sensors();
  const auto robot =
      prepare_input(options({set("dataset", folder_.string())}, Agent::kRobot), Agent::kRobot, stop_);
  ASSERT_EQ(robot.lasers.size(), 1U);
  EXPECT_EQ(robot.lasers[0].laser, "laser_rear");
  EXPECT_FALSE(robot.T_BS) << "this calibration does not say where the camera sits";
  std::vector<SampleKind> kinds;
  for (const Sample& sample : all_of(*robot.open()))
    kinds.push_back(kind_of(sample));
  using enum SampleKind;
  EXPECT_THAT(kinds, ElementsAre(kWearerPose, kImage, kWheelOdometry, kLaserScan, kImu, kLaserScan,
                                 kWearerPose, kImage, kImage));
}

TEST_F(AgentInputTest, TheSameFilesBesideImages) {
  make_dataset();
  add_robot_sensors();
  const auto in_robot = [&](const std::string& key, const std::string& name) {
    return set(key, (folder_ / "robot" / name).string());
  };
  std::vector<ConfigOverride> given = {in_robot("images", "cam0.csv"),
                                       in_robot("calibration", "calibration.yaml"),
                                       in_robot("laser_rear", "laser_rear.csv")};
  EXPECT_THAT(error_of<ConfigError>([&] { options(given, Agent::kRobot); }),
              HasSubstr("input.lasers: is missing"));
  given.push_back(in_robot("lasers", "lasers.yaml"));
  given.push_back(in_robot("odometry", "odometry.csv"));
  given.push_back(in_robot("imu", "imu.csv"));
  given.push_back(in_robot("known_points", "known_points.csv"));
  const auto robot = prepare_input(options(given, Agent::kRobot), Agent::kRobot, stop_);
  EXPECT_EQ(robot.lasers.size(), 1U);
  EXPECT_EQ(robot.known_points.size(), 1U);
  EXPECT_EQ(all_of(*robot.open()).size(), 7U);
  given.push_back(in_robot("laser_front", "laser_rear.csv"));
  EXPECT_THAT(
      error_of<ConfigError>([&] { prepare_input(options(given, Agent::kRobot), Agent::kRobot, stop_); }),
      HasSubstr("input.laser_front: "));
}

TEST_F(AgentInputTest, BesideTopicsADatasetSaysOnlyHowTheRobotIsBuilt) {
  make_dataset();
  add_robot_sensors();
  const auto bare = prepare_input(options({set("topics", "true")}, Agent::kRobot), Agent::kRobot, stop_);
  EXPECT_TRUE(bare.live);
  EXPECT_FALSE(bare.open);
  EXPECT_FALSE(bare.knows_camera);
  const auto built =
      prepare_input(options({set("topics", "true"), set("dataset", folder_.string())}, Agent::kRobot),
                    Agent::kRobot, stop_);
  EXPECT_FALSE(built.open);
  EXPECT_TRUE(built.knows_camera);
  EXPECT_EQ(built.camera.width, 32);
  EXPECT_EQ(built.lasers.size(), 1U);
  EXPECT_FALSE(built.has_wearer_pose);
  EXPECT_THAT(error_of<ConfigError>([&] {
                options({set("topics", "true"), set("video", "b")}, Agent::kRobot);
              }),
              HasSubstr("only one of dataset, images, video, device, topics and recording"));
}

TEST_F(AgentInputTest, AWrongSizeAgainstTheCalibrationIsCounted) {
  make_dataset();
  write_frame("wearer/cam0/1.jpg", 0, 31, 24);
  const auto source = CosightDataset(folder_).open_wearer();
  EXPECT_EQ(sequences_of(all_of(*source)).size(), 2U);
  EXPECT_EQ(source->counters().wrong_size, 1U);
}

TEST_F(AgentInputTest, ImagesWithTheirOwnCalibrationAndOrientations) {
  make_dataset();
  const auto input = prepare_input(
      options({set("images", (folder_ / "wearer/cam0.csv").string()),
               set("ahrs", (folder_ / "wearer/ahrs.csv").string()),
               set("calibration", (folder_ / "wearer/calibration.yaml").string()), set("encoding", "raw")}),
      Agent::kWearer, stop_);
  const auto samples = all_of(*input.open());
  ASSERT_EQ(samples.size(), 4U);
  EXPECT_EQ(std::get<ImageSample>(samples[0]).encoding, ImageEncoding::kMono8);
}

TEST_F(AgentInputTest, WhatIsMissingIsNamedBeforeAnythingPlays) {
  make_dataset();
  EXPECT_THAT(error_with({}), HasSubstr("input.dataset: give one of dataset, images, video and device"));
  EXPECT_THAT(error_with({set("dataset", "a"), set("video", "b")}), HasSubstr("only one of"));
  EXPECT_THAT(error_with({set("dataset", (folder_ / "none").string())}), HasSubstr("none: no such folder"));
  EXPECT_THAT(error_with({set("dataset", folder_.string()), set("gate", "3:1")}),
              HasSubstr("--gate: input.gate: is no list"));
  EXPECT_THAT(error_with({set("images", (folder_ / "wearer/cam0.csv").string())}),
              HasSubstr("input.calibration: is missing"));
  EXPECT_THAT(error_with({set("dataset", folder_.string()), set("encoding", "gif")}),
              HasSubstr("is none of jpeg, png, raw"));
  std::filesystem::remove(folder_ / "wearer/cam0.csv");
  EXPECT_THAT(error_with({set("dataset", folder_.string())}), HasSubstr("cam0.csv: can't be read"));
  std::filesystem::remove(folder_ / "wearer/calibration.yaml");
  EXPECT_THAT(error_with({set("dataset", folder_.string())}), HasSubstr("calibration.yaml: can't be read"));
}

TEST_F(AgentInputTest, ACameraThatIsNotThereIsNamedWhenItIsOpened) {
  make_dataset();
  const auto input =
      prepare_input(options({set("device", "/dev/no_such_camera"),
                             set("calibration", (folder_ / "wearer/calibration.yaml").string())}),
                    Agent::kWearer, stop_);
  EXPECT_TRUE(input.live);
  EXPECT_THAT(error_of<DatasetError>([&] { input.open(); }),
              HasSubstr("/dev/no_such_camera: can't be opened"));
}

}  // namespace
}  // namespace cosight
