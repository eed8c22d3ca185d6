#include <sys/mount.h>

#include <fstream>
#include <utility>

#include "shared/image/gray_image.hpp"
#include "shared/image/image_codec.hpp"
#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

using Cells = std::vector<std::string>;

/// A robot alone with a copy of the small scene that the test spoils.
class BadInput : public Session {
 protected:
  BadInput() { copy_small_scene(dataset()); }

  fs::path dataset() const { return in_folder("dataset"); }
  fs::path robot_image(const std::string& number) const {
    return dataset() / "robot/cam0" / ("0000" + number + ".jpg");
  }
  Ending run_alone() { return robot(dataset(), {"--mode", "mono", "--rate", "0"})->wait(); }
};

TEST_F(BadInput, WhatCannotBeUsedIsCountedAndTheRestIsComplete) {
  fs::resize_file(robot_image("05"), fs::file_size(robot_image("05")) / 2);
  write_image(robot_image("10"), {160, 120, std::vector<std::uint8_t>(160 * 120, 90)});
  change_rows(dataset() / "robot/cam0.csv", [](std::size_t row, Cells& cells) {
    if (row == 15) cells[0] = "1000100000001";
  });
  change_rows(dataset() / "robot/wearer_pose.csv", [](std::size_t row, Cells& cells) {
    if (row == 20) cells[1] = "nan";
  });
  const Ending ending = run_alone();
  EXPECT_EQ(ending.exit_code, 3) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("4 samples of the robot's own input could not be used"));
  const RunFiles run = run_files();
  EXPECT_THAT(run, IsCompleteToTheLastFrame(kFrames - 3, dataset()));
  EXPECT_EQ(run.summary("own_sensors.unreadable"), 1);
  EXPECT_EQ(run.summary("own_sensors.wrong_size"), 1);
  EXPECT_EQ(run.summary("own_sensors.stamp_went_back"), 1);
  EXPECT_EQ(run.summary("own_sensors.not_finite"), 1);
  EXPECT_EQ(run.summary("frames_lost"), 0);
}

TEST_F(BadInput, AGapIsCountedAndLosesNothing) {
  change_rows(dataset() / "robot/cam0.csv", [](std::size_t row, Cells& cells) {
    if (row >= 20 && row < 24) cells.clear();
  });
  const Ending ending = run_alone();
  EXPECT_EQ(ending.exit_code, 0) << ending.err;
  EXPECT_THAT(run_files(), IsCompleteToTheLastFrame(kFrames - 4, dataset()));
  EXPECT_EQ(run_files().summary("own_sensors.gaps"), 1);
}

TEST_F(BadInput, AnUnknownDistortionModelIsRefusedByName) {
  const fs::path file = dataset() / "robot/calibration.yaml";
  std::string text = text_of(file);
  const std::string none = "distortion_model: none";
  text.replace(text.find(none), none.size(), "distortion_model: fov");
  std::ofstream(file) << text;
  const Ending ending = run_alone();
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_EQ(ending.err, "robot_agent: " + file.string() +
                            ":5: cam0.distortion_model: unknown distortion model 'fov'; known are radtan, "
                            "equidistant, none\n");
}

TEST_F(BadInput, ARunFolderThatIsAFileIsRefused) {
  std::ofstream(in_folder("taken")) << "x";
  write_into(in_folder("taken/run"));
  const Ending ending = run_alone();
  EXPECT_EQ(ending.exit_code, 1);
  EXPECT_THAT(ending.err, HasSubstr("taken/run: the run folder can't be used: "));
}

/// Memory that behaves as a small disk; needs root.
class SmallDisk {
 public:
  SmallDisk(fs::path folder, const std::string& size) : folder_(std::move(folder)) {
    fs::create_directory(folder_);
    is_there_ = ::mount("none", folder_.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_there_) ::umount(folder_.c_str());
  }

  bool is_there() const { return is_there_; }
  void fill() const {
    std::ofstream file(folder_ / "filler");
    for (const std::string megabyte(1'000'000, 'x'); file.good();)
      file << megabyte << std::flush;
  }

 private:
  fs::path folder_;
  bool is_there_ = false;
};

TEST_F(BadInput, AFullDiskIsRefusedBeforeTheFirstFrame) {
  const SmallDisk disk(in_folder("disk"), "64k");
  if (!disk.is_there()) GTEST_SKIP() << "a small disk needs root";
  write_into(in_folder("disk/run"));
  const Ending ending = run_alone();
  EXPECT_EQ(ending.exit_code, 1);
  EXPECT_THAT(ending.err, HasSubstr(run_folder().string() + ": the run folder can't be used: only 0 MB"));
}

TEST_F(BadInput, ADiskThatFillsUpInTheMiddleIsToldAtTheEnd) {
  const SmallDisk disk(in_folder("disk"), "20m");
  if (!disk.is_there()) GTEST_SKIP() << "a small disk needs root";
  write_into(in_folder("disk/run"));
  const auto robot_process = robot(dataset(), {"--mode", "mono"});
  ASSERT_TRUE(robot_reaches(5));
  disk.fill();
  const Ending ending = robot_process->wait();
  EXPECT_EQ(ending.exit_code, 3) << ending.err;
  EXPECT_THAT(ending.err, testing::ContainsRegex("frames.csv: [0-9]+ lines are missing: No space left"));
  EXPECT_THAT(ending.err, HasSubstr("summary.yaml: can't be written"));
}

}  // namespace
}  // namespace cosight::integration
