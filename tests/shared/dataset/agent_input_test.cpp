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

  InputOptions options(const std::vector<ConfigOverride>& overrides) const {
    const ConfigFile file = ConfigFile::parse("", "test.yaml", overrides);
    InputOptions read = read_input_options(file.root().section("input"), Agent::kWearer);
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
