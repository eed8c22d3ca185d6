#include <csignal>

#include <filesystem>
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
