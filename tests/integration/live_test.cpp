#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

using testing::Ge;

class LiveSimulation : public Session {};

TEST_F(LiveSimulation, ARobotOnTopicsAloneFindsItselfAndItsWearer) {
  const auto world = live_scene();
  const auto cosight = robot_on_topics({"--dataset", small_scene().string()});
  EXPECT_EQ(world->wait().exit_code, 0);
  EXPECT_EQ(cosight->wait().exit_code, 0);
  const RunFiles files = run_files();
  EXPECT_EQ(files.summary("inbox.robot_frames"), kFrames);
  EXPECT_EQ(files.trajectory().size(), files.frames_with_scale());
  EXPECT_EQ(files.summary("inbox.robot_lost"), 0);
  EXPECT_THAT(files.summary("wearer_by_laser.seen"), Ge(100)) << "two lasers at 25 Hz for four seconds";
  EXPECT_THAT(files.summary("inbox.paired"), Ge(kFrames / 2)) << "with poses that the lasers gave";
}

TEST_F(LiveSimulation, ATrackerOnATopicIsPreferredToTheLasers) {
  const auto world = live_scene({"--tracker"});
  const auto cosight = robot_on_topics({"--dataset", small_scene().string()});
  EXPECT_EQ(world->wait().exit_code, 0);
  EXPECT_EQ(cosight->wait().exit_code, 0);
  EXPECT_THAT(run_files().summary("inbox.wearer_poses"), Ge(kFrames - 1));
  EXPECT_TRUE(says(*cosight, "a tracker says where the wearer is"));
}

TEST_F(LiveSimulation, WhoKnowsNothingOfTheRobotStillGetsItsCamera) {
  const auto world = live_scene();
  const auto cosight = robot_on_topics();
  EXPECT_EQ(world->wait().exit_code, 0);
  EXPECT_EQ(cosight->wait().exit_code, 0);
  EXPECT_EQ(run_files().summary("inbox.robot_frames"), kFrames);
}

}  // namespace
}  // namespace cosight::integration
