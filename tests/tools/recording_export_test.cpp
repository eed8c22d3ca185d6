#include "tools/recording_export.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "shared/dataset/agent_input.hpp"
#include "shared/evaluation/csv_table.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "shared/image/image_codec.hpp"
#include "shared/recording/sample_recorder.hpp"
#include "shared/transport/codec.hpp"
#include "tests/shared/transport/equal_samples.hpp"
#include "tests/shared/transport/example_samples.hpp"
#include "tests/tools/scratch_folder.hpp"

namespace cosight {
namespace {

using recording::McapReader;
using recording::McapWriter;

/// Five frames of each camera, the robot's raw, and twenty inertial samples of each agent.
class RecordingExport : public testing::Test {
 protected:
  RecordingExport() {
    camera_.width = kWidth;
    camera_.height = kHeight;
    recorder_.write(Agent::kRobot, camera_, 0);
    recorder_.write(Agent::kWearer, camera_, 0);
    for (int i = 0; i < 5; ++i) {
      robot_.push_back(example_.image(ImageEncoding::kMono8, kWidth, kHeight));
      robot_.back().stamp += 100 * i;
      worn_.push_back(robot_.back());
      GrayImage pixels;
      pixels.width = kWidth;
      pixels.height = kHeight;
      pixels.data = worn_.back().bytes;
      worn_.back().encoding = ImageEncoding::kPng;
      encode_png(pixels, worn_.back().bytes);
      recorder_.write(Agent::kRobot, robot_.back());
      recorder_.write(Agent::kWearer, worn_.back());
    }
    for (int i = 0; i < 20; ++i) {
      imu_.push_back(example_.imu());
      imu_.back().stamp += i;
      ahrs_.push_back(example_.ahrs());
      ahrs_.back().stamp += i;
      recorder_.write(Agent::kRobot, imu_.back());
      recorder_.write(Agent::kWearer, ahrs_.back());
    }
  }

  const McapReader& reader() {
    if (!reader_) {
      writer_.close();
      reader_ = std::make_unique<McapReader>(std::make_unique<recording::MemorySource>(sink_.bytes()));
    }
    return *reader_;
  }

  static constexpr int kWidth = 40, kHeight = 30;
  ScratchFolder folder_{"export"};
  transport::ExampleSamples example_;
  CameraModel camera_ = example_.camera_info(Distortion::kRadtan).camera;
  std::vector<ImageSample> robot_, worn_;
  std::vector<ImuSample> imu_;
  std::vector<AhrsSample> ahrs_;
  recording::MemorySink sink_;
  McapWriter writer_{sink_};
  recording::SampleRecorder recorder_{writer_};

 private:
  std::unique_ptr<McapReader> reader_;
};

TEST_F(RecordingExport, EurocsFoldersAreReadByOurOwnReader) {
  const Exported exported = export_euroc(reader(), folder_.path());
  EXPECT_EQ(exported.images, 10U);
  EXPECT_EQ(exported.rows, 40U);
  EXPECT_EQ(exported.unusable, 0U);
  const std::atomic<bool> stop = false;
  for (const auto& [name, frames] : {std::pair{"robot", &robot_}, std::pair{"wearer", &worn_}}) {
    SCOPED_TRACE(name);
    InputOptions options;
    options.images = folder_.path() / name;
    options.output.encoding = ImageEncoding::kMono8;
    const AgentInput input = prepare_input(options, Agent::kRobot, stop);
    EXPECT_EQ(input.camera.fx, camera_.fx);
    EXPECT_EQ(input.camera.cy, camera_.cy);
    EXPECT_EQ(input.camera.width, kWidth);
    const auto source = input.open();
    for (std::size_t i = 0; i < frames->size(); ++i) {
      const auto sample = source->next();
      ASSERT_TRUE(sample);
      const auto& frame = std::get<ImageSample>(*sample);
      EXPECT_EQ(frame.stamp, (*frames)[i].stamp);
      EXPECT_EQ(frame.bytes, robot_[i].bytes);  // both cameras saw the same
    }
    EXPECT_FALSE(source->next());
  }
}

TEST_F(RecordingExport, EurocsImuIsToTheLastBitWhatWasRecorded) {
  export_euroc(reader(), folder_.path());
  const auto robot = CsvTable::read(folder_.path() / "robot/mav0/imu0/data.csv");
  const auto wearer = CsvTable::read(folder_.path() / "wearer/mav0/imu0/data.csv");
  ASSERT_EQ(robot.rows(), imu_.size());
  ASSERT_EQ(wearer.rows(), ahrs_.size());
  for (std::size_t i = 0; i < imu_.size(); ++i) {
    EXPECT_EQ(robot.stamp(i, "timestamp [ns]"), imu_[i].stamp);
    EXPECT_EQ(robot.number(i, "w_RS_S_y [rad s^-1]"), imu_[i].angular_velocity_I.y());
    EXPECT_EQ(wearer.number(i, "a_RS_S_z [m s^-2]"), ahrs_[i].acceleration_H.z());
  }
}

TEST_F(RecordingExport, TrajectoriesAreThoseOfTheOdometryAndOfTheTracker) {
  const WearerPoseSample pose = example_.wearer_pose(true);
  recorder_.write(Agent::kRobot, pose);
  const Exported exported = export_tum(reader(), folder_.path());
  EXPECT_EQ(exported.rows, 1U);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "robot.tum")) << "nobody told an odometry";
  const Trajectory wearer = read_trajectory(folder_.path() / "wearer.tum");
  ASSERT_EQ(wearer.size(), 1U);
  EXPECT_TRUE(wearer[0].T_WC.p.isApprox(pose.T_SF.T.p, 1e-6));
}

TEST_F(RecordingExport, ImagesAreTheFramesAlone) {
  EXPECT_EQ(export_images(reader(), folder_.path()).images, 10U);
  const auto file = folder_.path() / "wearer" / (std::to_string(worn_[3].stamp) + ".png");
  EXPECT_EQ(std::filesystem::file_size(file), worn_[3].bytes.size());
}

}  // namespace
}  // namespace cosight
