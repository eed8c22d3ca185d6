#include <csignal>

#include <filesystem>
#include <map>
#include <string>

#include "shared/recording/mcap_reader.hpp"
#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

namespace fs = std::filesystem;
using recording::McapReader;

class RecordedSession : public Session {
 protected:
  /// Both agents' small scene, recorded; the robot's run folder is `live`.
  fs::path record_small_scene() {
    const fs::path file = in_folder("trial.mcap");
    const auto recording = recorder(file);
    write_into(in_folder("live"));
    const auto robot_process = robot(small_scene());
    EXPECT_TRUE(says(*robot_process, "waiting up to"));  // the wearer would take the recorder for the robot
    const auto wearer_process = wearer(small_scene());
    EXPECT_EQ(wearer_process->wait().exit_code, 0);
    EXPECT_EQ(robot_process->wait().exit_code, 0);
    recording->send(SIGINT);
    const Ending ending = recording->wait();
    EXPECT_EQ(ending.exit_code, 0) << ending.err;
    return file;
  }
};

TEST_F(RecordedSession, GivesTheSameBytesAtEveryRunOffline) {
  const fs::path file = record_small_scene();
  for (const char* run : {"first", "second"}) {
    write_into(in_folder(run));
    const Ending ending = robot_from(file)->wait();
    ASSERT_EQ(ending.exit_code, 0) << ending.err;
  }
  for (const char* name : {"trajectory.tum", "frames.csv", "map.ply", "map.pcd"}) {
    const std::string first = text_of(in_folder("first") / name);
    EXPECT_FALSE(first.empty()) << name;
    EXPECT_EQ(first, text_of(in_folder("second") / name)) << name;
  }
  write_into(in_folder("first"));
  const RunFiles offline = run_files();
  EXPECT_THAT(offline, IsCompleteToTheLastFrame(kFrames, small_scene()));
  EXPECT_GT(offline.summary("inbox.paired"), kFrames / 2);
}

TEST_F(RecordedSession, GivesOfflineWhatTheLiveRunGaveWhereNothingWasLate) {
  const fs::path file = record_small_scene();
  write_into(in_folder("live"));
  const RunFiles live = run_files();
  write_into(in_folder("offline"));
  ASSERT_EQ(robot_from(file, {"--dataset", small_scene()})->wait().exit_code, 0);
  const RunFiles offline = run_files();
  for (const char* counter : {"inbox.worn_frames", "inbox.ahrs_samples", "inbox.wait_timeouts"}) {
    if (live.summary(counter) != offline.summary(counter))
      GTEST_SKIP() << counter << ": the live run had " << live.summary(counter) << ", the file "
                   << offline.summary(counter) << "; the machine was too busy to compare them";
  }
  for (const char* name : {"trajectory.tum", "map.ply", "map.pcd"})
    EXPECT_EQ(text_of(in_folder("live") / name), text_of(in_folder("offline") / name)) << name;
}

TEST_F(RecordedSession, IsWrittenByTheSimulatorWithoutDds) {
  const fs::path file = in_folder("sim.mcap");
  ChildProcess sim(SIM,
                   {"--config", small_scene_file(), "--out", in_folder("dataset"), "--record", file, "--seed",
                    "1", "--set", "duration_s=1"},
                   in_folder("sim"));
  const Ending rendered = sim.wait();
  ASSERT_EQ(rendered.exit_code, 0) << rendered.err;
  constexpr int kRendered = 11;
  const McapReader reader(file);
  EXPECT_TRUE(reader.contents().is_indexed);
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [id, channel] : reader.contents().channels)
    counts[channel.topic] = reader.contents().message_counts.at(id);
  EXPECT_EQ(counts["/cosight/robot/image/compressed"], kRendered);
  EXPECT_EQ(counts["/cosight/wearable/image/compressed"], kRendered);
  EXPECT_EQ(counts["/cosight/robot/camera_info"], 1U);
  EXPECT_GT(counts["/cosight/wearable/imu"], 90U);
  write_into(in_folder("offline"));
  const Ending ending = robot_from(file, {"--dataset", in_folder("dataset")})->wait();
  EXPECT_EQ(ending.exit_code, 0) << ending.err;
  EXPECT_THAT(run_files(), IsCompleteToTheLastFrame(kRendered, in_folder("dataset")));
}

TEST_F(RecordedSession, IsReadableWhenTheRecorderIsKilled) {
  const fs::path file = in_folder("killed.mcap");
  const auto recording = recorder(file);
  const auto robot_process = robot(small_scene());
  const auto wearer_process = wearer(small_scene());
  ASSERT_TRUE(robot_reaches(kFrames / 2));
  recording->send(SIGKILL);
  EXPECT_EQ(recording->wait().exit_code, 128 + SIGKILL);
  EXPECT_EQ(wearer_process->wait().exit_code, 0);
  EXPECT_EQ(robot_process->wait().exit_code, 0);

  const McapReader reader(file);
  EXPECT_FALSE(reader.contents().is_indexed);
  EXPECT_EQ(reader.contents().damaged, 0U);
  recording::MessageFilter frames;
  frames.wants = [](const recording::Channel& channel) {
    return channel.topic == "/cosight/robot/image/compressed";
  };
  auto cursor = reader.messages(frames);
  int found = 0;
  while (cursor.next())
    ++found;
  EXPECT_GT(found, kFrames / 2 - 10);  // half a second is five frames
}

}  // namespace
}  // namespace cosight::integration
