#include "robot_agent/outbox/run_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <csignal>
#include <fstream>
#include <sstream>

#include "robot_agent/outbox/output_error.hpp"
#include "shared/evaluation/frame_log.hpp"

namespace cosight::outbox {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class RunFiles : public testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::temp_directory_path() / ("cosight_run_files_" + std::to_string(::getpid()));
    fs::remove_all(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  static std::vector<std::string> lines(const fs::path& path) {
    std::ifstream file(path);
    std::vector<std::string> result;
    for (std::string line; std::getline(file, line);)
      result.push_back(line);
    return result;
  }
  static FrameEstimate frame(int number) {
    FrameEstimate estimate;
    estimate.stamp = from_seconds(0.1 * number);
    estimate.tracking = Tracking::kTracking;
    return estimate;
  }

  fs::path root_;
};

TEST_F(RunFiles, AFolderIsMadeWithItsParents) {
  const RunFolder folder(root_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(root_ / "a" / "b"));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST_F(RunFiles, AnEarlierRunIsNeverOverwritten) {
  std::ofstream((RunFolder(root_ / "run") / "trajectory.tum")) << "precious\n";
  const RunFolder second(root_ / "run/");
  EXPECT_EQ(second.path(), root_ / "run-2");
  std::ofstream(second / "x") << "x";
  EXPECT_EQ(RunFolder(root_ / "run").path(), root_ / "run-3");
  EXPECT_EQ(lines(root_ / "run" / "trajectory.tum").at(0), "precious");
}

TEST_F(RunFiles, AnEmptyFolderIsUsed) {
  fs::create_directories(root_ / "run");
  EXPECT_EQ(RunFolder(root_ / "run").path(), root_ / "run");
}

TEST_F(RunFiles, LatestFollowsTheNewestRunButReplacesNoFolder) {
  const RunFolder first(root_ / "one", {.link_latest = true});
  const RunFolder second(root_ / "two", {.link_latest = true});
  EXPECT_EQ(fs::read_symlink(root_ / "latest"), "two");
  fs::remove(root_ / "latest");
  fs::create_directories(root_ / "latest");
  const RunFolder third(root_ / "three", {.link_latest = true});
  EXPECT_FALSE(fs::is_symlink(root_ / "latest"));
}

TEST_F(RunFiles, AFileInTheWayIsAClearError) {
  fs::create_directories(root_);
  std::ofstream(root_ / "file") << "x";
  EXPECT_THROW(RunFolder(root_ / "file" / "run"), OutputError);
  EXPECT_THROW(RunFolder("/proc/cosight/run"), OutputError);
}

TEST_F(RunFiles, TooLittleRoomIsAClearErrorAtTheStart) {
  try {
    const RunFolder folder(root_ / "run", {.min_free_bytes = std::uintmax_t{1} << 62});
    FAIL() << "no error";
  } catch (const OutputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("MB are free"));
  }
}

TEST_F(RunFiles, LinesAreOnDiskAsSoonAsTheyAreAppended) {
  fs::create_directories(root_);
  LineFile file(root_ / "lines");
  file.append("one");
  EXPECT_EQ(lines(root_ / "lines"), std::vector<std::string>{"one"});
  file.append("two");
  EXPECT_EQ(lines(root_ / "lines"), (std::vector<std::string>{"one", "two"}));
}

TEST_F(RunFiles, AFullDiskIsCountedNotThrown) {
  LineFile file("/dev/full");
  file.append("one");
  EXPECT_FALSE(file.failure().empty());
  EXPECT_EQ(file.lost_lines(), 0U);  // still hoping for room
  file.append("two");
  file.close();
  EXPECT_EQ(file.lost_lines(), 2U);
}

TEST_F(RunFiles, LinesThatFoundNoRoomFollowWhenThereIsSomeAgain) {
  fs::create_directories(root_);
  const auto previous_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit previous{};
  ::getrlimit(RLIMIT_FSIZE, &previous);
  rlimit tight = previous;
  tight.rlim_cur = 10;  // the file system refuses a file to grow past ten bytes, in the middle of a line
  LineFile file(root_ / "lines");
  ::setrlimit(RLIMIT_FSIZE, &tight);
  for (const char* line : {"first", "second", "third"})
    file.append(line);
  EXPECT_FALSE(file.failure().empty());
  ::setrlimit(RLIMIT_FSIZE, &previous);
  file.append("fourth");
  EXPECT_TRUE(file.failure().empty());
  std::signal(SIGXFSZ, previous_handler);
  EXPECT_EQ(lines(root_ / "lines"), (std::vector<std::string>{"first", "second", "third", "fourth"}));
  EXPECT_EQ(file.lost_lines(), 0U);
}

TEST_F(RunFiles, AKilledRunKeepsEveryFrame) {
  const pid_t child = ::fork();
  if (child == 0) {
    RunRecord record(RunFolder(root_ / "run"), {"0", "mono", ""});
    for (int i = 0; i < 50; ++i)
      record.add({}, frame(i));
    ::raise(SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(lines(root_ / "run" / "trajectory.tum").size(), 51U);
  EXPECT_EQ(read_frame_log(root_ / "run" / "frames.csv").size(), 50U);
}

TEST_F(RunFiles, TheTrajectoryBeginsWithTheScale) {
  RunRecord record(RunFolder(root_ / "run"), {"0", "collaborative", ""});
  for (int i = 0; i < 10; ++i) {
    FrameEstimate estimate = frame(i);
    if (i < 4) estimate.tracking = Tracking::kWaitingForScale;
    record.add({}, estimate);
  }
  record.finish({}, 1.0, {});
  EXPECT_EQ(lines(root_ / "run" / "trajectory.tum").size(), 1U + 6U);
  EXPECT_EQ(read_frame_log(root_ / "run" / "frames.csv").size(), 10U);
}

TEST_F(RunFiles, AFinishedRunIsComplete) {
  const RunFolder folder(root_ / "run");
  RunRecord record(folder, {"0.1.0", "collaborative", "slam:\n  max_landmarks: 60\n"});
  for (int i = 0; i < 5; ++i)
    record.add({}, frame(i));
  std::vector<MapPoint> map(2);
  const auto problems = record.finish(
      map, 10.0, [](YamlText& text) { text.section("inbox").value("paired", std::uint64_t{5}); });
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(lines(folder / "config.yaml").at(1), "  max_landmarks: 60");
  EXPECT_TRUE(fs::exists(folder / "map.ply"));
  EXPECT_TRUE(fs::exists(folder / "map.pcd"));
  const YAML::Node summary = YAML::LoadFile(folder / "summary.yaml");
  EXPECT_EQ(summary["mode"].as<std::string>(), "collaborative");
  EXPECT_EQ(summary["frames"].as<int>(), 5);
  EXPECT_EQ(summary["map_points"].as<int>(), 2);
  EXPECT_EQ(summary["inbox"]["paired"].as<int>(), 5);
  EXPECT_GT(summary["cpu_percent"].as<double>(), 0.0);
  EXPECT_GT(summary["peak_memory_mb"].as<double>(), 1.0);
}

TEST_F(RunFiles, EvaluationReadsTheFrameLog) {
  const RunFolder folder(root_ / "run");
  RunRecord record(folder, {});
  FrameEstimate estimate = frame(1);
  estimate.overlap.predicted = true;
  estimate.pseudo_stereo.initialised = 2;
  estimate.landmarks = 12;
  estimate.timings.total = 4.5;
  record.add({}, estimate);
  const auto rows = read_frame_log(folder / "frames.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].stamp, from_seconds(0.1));
  EXPECT_TRUE(rows[0].pseudo_stereo);
  EXPECT_EQ(rows[0].landmarks, 12.0);
  EXPECT_EQ(rows[0].total_ms, 4.5);
}

TEST_F(RunFiles, AFolderThatVanishesIsReportedAsLostData) {
  const RunFolder folder(root_ / "run");
  RunRecord record(folder, {});
  record.add({}, frame(0));
  fs::remove_all(folder.path());
  const auto problems = record.finish({}, 1.0);
  EXPECT_EQ(problems.size(), 2U);  // the map and the summary
}

}  // namespace
}  // namespace cosight::outbox
