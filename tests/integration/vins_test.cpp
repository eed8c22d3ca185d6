#include <sstream>
#include <string>

#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

namespace fs = std::filesystem;

int poses_of(const fs::path& trajectory) {
  std::istringstream in(text_of(trajectory));
  int poses = 0;
  for (std::string line; std::getline(in, line);)
    poses += line.starts_with('#') ? 0 : 1;
  return poses;
}

class VinsSession : public Session {
 protected:
  /// The small scene as a recording, without DDS.
  fs::path import_small_scene() {
    const fs::path file = in_folder("scene.mcap");
    ChildProcess import(COSIGHT, {"import", small_scene().string(), file.string()}, in_folder("import"));
    EXPECT_EQ(import.wait().exit_code, 0);
    return file;
  }

  /// Where the files of a run that was fed by `recording` are.
  fs::path offline_run(const fs::path& recording, const char* name, const Arguments& more) {
    write_into(in_folder(name));
    Arguments arguments{"--dataset", small_scene().string()};  // a recording does not tell T_BC
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ending ending = robot_from(recording, arguments)->wait();
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
    return run_folder();
  }
};

TEST_F(VinsSession, LeavesSlamsBytesAsTheyAreUnlessItGuidesSlam) {
  const fs::path recording = import_small_scene();
  const fs::path without = offline_run(recording, "without", {});
  const Arguments alone{"--set", "vins.enable=true", "--set", "vins.guide_slam=false"};
  const fs::path with = offline_run(recording, "with", alone);
  const fs::path again = offline_run(recording, "again", alone);
  for (const char* name : {"trajectory.tum", "frames.csv", "map.ply", "map.pcd"})
    EXPECT_EQ(text_of(without / name), text_of(with / name)) << name;
  EXPECT_EQ(text_of(with / "vins.tum"), text_of(again / "vins.tum"));
  EXPECT_FALSE(fs::exists(without / "vins.tum"));
  EXPECT_EQ(RunFiles(with).summary("vins.images"), kFrames);
  EXPECT_EQ(RunFiles(with).summary("vins.images_dropped"), 0);
}

TEST_F(VinsSession, RunsAloneAndCountsWhatWasMissingBeforeItStarted) {
  const Ending ending = robot(small_scene(), {"--only", "vins", "--rate", "0"})->wait();
  ASSERT_EQ(ending.exit_code, 0) << ending.err;
  EXPECT_FALSE(fs::exists(run_folder() / "trajectory.tum"));
  EXPECT_TRUE(fs::exists(run_folder() / "vins.tum"));
  const RunFiles files = run_files();
  EXPECT_EQ(files.summary("vins.images"), kFrames);
  const int tracking = files.summary("vins.frames_tracking");
  int missing = 0;
  for (const char* what : {"too few frames", "too few tracks", "too little parallax", "no solution",
                           "scale unobservable", "camera and IMU inconsistent"})
    missing += files.summary(std::string("vins_not_yet_observable.") + what);
  EXPECT_EQ(tracking + missing, kFrames);
  EXPECT_GT(tracking, 0);
  EXPECT_EQ(poses_of(run_folder() / "vins.tum"), tracking);
  EXPECT_GT(files.summary("vins.imu_samples"), 700);
}

TEST_F(VinsSession, GuidesSlamAndTakesItsDepthsTheSameWayEachTime) {
  const fs::path recording = import_small_scene();
  const fs::path alone = offline_run(recording, "alone", {});
  const Arguments both{"--set", "vins.enable=true"};
  const fs::path first = offline_run(recording, "first", both);
  const fs::path again = offline_run(recording, "again", both);
  for (const char* name : {"trajectory.tum", "frames.csv", "vins.tum"})
    EXPECT_EQ(text_of(first / name), text_of(again / name)) << name;
  EXPECT_NE(text_of(first / "trajectory.tum"), text_of(alone / "trajectory.tum"));
  const int tracking = RunFiles(first).summary("vins.frames_tracking");
  EXPECT_GT(tracking, 0);
  EXPECT_EQ(RunFiles(first).summary("vins_guide.frames"), tracking - 1);
  EXPECT_EQ(RunFiles(first).summary("vins.images"), kFrames);
  EXPECT_GT(RunFiles(first).summary("vins.distances"), 0);
  EXPECT_GT(RunFiles(first).summary("vins.distances_given"), 0);
}

TEST_F(VinsSession, GetsItsImagesFromTheCameraWhereItTakesNoDepths) {
  const fs::path recording = import_small_scene();
  const Arguments own{"--set", "vins.enable=true", "--set", "vins.take_depths=false"};
  const fs::path run = offline_run(recording, "own", own);
  EXPECT_EQ(RunFiles(run).summary("vins.images"), kFrames);
  EXPECT_EQ(RunFiles(run).summary("vins.distances"), 0);
  EXPECT_GT(RunFiles(run).summary("vins.frames_tracking"), 0);
}

TEST_F(VinsSession, CountsImuSamplesThatCannotBeUsedAndTracksOn) {
  const fs::path dataset = in_folder("dataset");
  copy_small_scene(dataset);
  change_rows(dataset / "robot/imu.csv", [](std::size_t row, std::vector<std::string>& cells) {
    if (row == 300) cells[2] = "nan";
    if (row == 310) cells[0] = "1000500000000";  // a clock that goes back, for one sample
    if (row == 320) cells[5] = "inf";
  });
  const Ending ending = robot(dataset, {"--only", "vins", "--rate", "0"})->wait();
  EXPECT_EQ(ending.exit_code, 3) << ending.err;
  EXPECT_NE(ending.err.find("3 samples of the robot's own input"), std::string::npos) << ending.err;
  const RunFiles files = run_files();
  EXPECT_EQ(files.summary("own_sensors.not_finite"), 2);
  EXPECT_EQ(files.summary("own_sensors.stamp_went_back"), 1);
  EXPECT_EQ(files.summary("vins.images_without_imu"), 0);
  EXPECT_GT(files.summary("vins.frames_tracking"), 0);
}

TEST_F(VinsSession, CountsImagesThatTheImuDoesNotReach) {
  const fs::path dataset = in_folder("dataset");
  copy_small_scene(dataset);
  change_rows(dataset / "robot/imu.csv", [](std::size_t row, std::vector<std::string>& cells) {
    if (row > 600) cells.clear();  // silent after three of the four seconds
  });
  const Ending ending = robot(dataset, {"--only", "vins", "--rate", "0"})->wait();
  const RunFiles files = run_files();
  EXPECT_EQ(files.summary("vins.images"), kFrames);
  EXPECT_EQ(files.summary("vins.images_without_imu") + files.summary("vins.images_dropped"), 10);
  EXPECT_EQ(ending.exit_code, files.summary("vins.images_dropped") > 0 ? 3 : 0) << ending.err;
}

TEST_F(VinsSession, RefusesToStartWithoutAnImu) {
  const fs::path dataset = in_folder("dataset");
  copy_small_scene(dataset);
  fs::remove(dataset / "robot/imu.csv");
  const Ending ending = robot(dataset, {"--only", "vins"})->wait();
  EXPECT_EQ(ending.exit_code, 2);
  EXPECT_NE(ending.err.find("vins.enable: needs the robot's IMU"), std::string::npos) << ending.err;
}

}  // namespace
}  // namespace cosight::integration
