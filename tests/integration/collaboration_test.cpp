#include <algorithm>
#include <csignal>

#include "tests/integration/session.hpp"

namespace cosight::integration {
namespace {

using testing::HasSubstr;
using testing::Not;

using Collaboration = Session;

/// After an interrupt; an ending later than that shows as killed. Half a second is usual, the rest is for a
/// machine that does much else.
constexpr std::chrono::seconds kSoon{5};

TEST_F(Collaboration, TwoAgentsRunToTheEndAndTheirViewsAreFused) {
  const auto robot_process = robot(small_scene());
  const auto wearer_process = wearer(small_scene());
  const Ending wearer_ending = wearer_process->wait();
  const Ending robot_ending = robot_process->wait();
  EXPECT_EQ(wearer_ending.exit_code, 0) << wearer_ending.err;
  EXPECT_EQ(robot_ending.exit_code, 0) << robot_ending.err;
  const RunFiles run = run_files();
  EXPECT_THAT(run, IsCompleteToTheLastFrame(kFrames, small_scene()));
  EXPECT_GT(run.summary("inbox.paired"), kFrames / 2);
  EXPECT_GT(run.count("fused"), kFrames / 4);
  EXPECT_GT(run.summary("pseudo_stereo.fused"), 0);
  EXPECT_EQ(run.summary("frames_lost"), 0);
  EXPECT_THAT(robot_ending.out, HasSubstr(run_folder().string() + "\n"));
}

TEST_F(Collaboration, NothingIsDrawnWhereNoTerminalIs) {
  const auto robot_process = robot(small_scene(), {"--rate", "4"});
  const auto wearer_process = wearer(small_scene(), {"--rate", "4"});
  const Ending wearer_ending = wearer_process->wait();
  const Ending robot_ending = robot_process->wait();
  for (const std::string& text : {robot_ending.err, robot_ending.out, wearer_ending.err, wearer_ending.out}) {
    EXPECT_THAT(text, Not(HasSubstr("\r")));
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
  }
}

TEST_F(Collaboration, PositionsOfTheFreeCameraAreEnoughWithAnAhrs) {
  copy_small_scene(in_folder("dataset"));
  change_rows(in_folder("dataset") / "robot/wearer_pose.csv",
              [](std::size_t, std::vector<std::string>& cells) {
                constexpr std::ptrdiff_t kQuaternion = 4;
                std::fill_n(cells.begin() + kQuaternion, 4, "");
              });
  const auto robot_process = robot(in_folder("dataset"));
  const auto wearer_process = wearer(in_folder("dataset"));
  EXPECT_EQ(wearer_process->wait().exit_code, 0);
  EXPECT_EQ(robot_process->wait().exit_code, 0);
  const RunFiles run = run_files();
  EXPECT_THAT(run, IsCompleteToTheLastFrame(kFrames, in_folder("dataset")));
  EXPECT_GT(run.summary("inbox.ahrs_samples"), 0);
  EXPECT_GT(run.summary("inbox.paired"), kFrames / 2);
  EXPECT_GT(run.count("fused"), kFrames / 4);
}

TEST_F(Collaboration, WithoutAWearerTheRobotGoesOnAlone) {
  const auto robot_process = robot(small_scene(), {"--wait-for-wearer", "1", "--rate", "4"});
  const Ending ending = robot_process->wait();
  EXPECT_EQ(ending.exit_code, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("no wearer came on domain"));
  EXPECT_THAT(ending.err, HasSubstr("start wearable_agent"));
  EXPECT_THAT(run_files(), IsCompleteToTheLastFrame(kFrames, small_scene()));
  EXPECT_EQ(run_files().count("worn_image"), 0);
}

TEST_F(Collaboration, AWearerKilledInTheMiddleIsTakenUpAgain) {
  // GIVEN a robot that sees through its wearer, at half the speed
  const auto robot_process = robot(small_scene(), {"--rate", "0.5"});
  auto first = wearer(small_scene(), {"--rate", "0.5"});
  ASSERT_TRUE(robot_reaches(6));
  // WHEN the wearer is killed and another takes its place, which soon is where the robot is
  first->send(SIGKILL);
  EXPECT_EQ(first->wait().exit_code, 128 + SIGKILL);
  const std::size_t killed_at = run_files().frames().size();
  const auto second = wearer(small_scene(), {"--rate", "4"});
  // THEN both end well, and the second is used
  const Ending second_ending = second->wait();
  const Ending robot_ending = robot_process->wait();
  EXPECT_EQ(second_ending.exit_code, 0) << second_ending.err;
  EXPECT_EQ(robot_ending.exit_code, 0) << robot_ending.err;
  const RunFiles run = run_files();
  EXPECT_THAT(run, IsCompleteToTheLastFrame(kFrames, small_scene()));
  EXPECT_EQ(run.summary("inbox.wearer_restarts"), 1);
  const auto frames = run.frames();
  EXPECT_TRUE(std::any_of(frames.begin() + static_cast<std::ptrdiff_t>(killed_at), frames.end(),
                          [](const auto& frame) { return frame.at("worn_image") == "0"; }));
  EXPECT_EQ(run.frames().back().at("worn_image"), "1");
  EXPECT_EQ(run.summary("frames_lost"), 0);
}

TEST_F(Collaboration, ASecondWearerOfTheSameIdIsSentAwayAndTheFirstStreamsOn) {
  const auto robot_process = robot(small_scene(), {"--rate", "0.7"});
  const auto first = wearer(small_scene(), {"--rate", "0.7"});
  ASSERT_TRUE(robot_reaches(3));
  const Ending second_ending = wearer(small_scene())->wait();
  EXPECT_EQ(second_ending.exit_code, 1);
  EXPECT_THAT(second_ending.err, HasSubstr("a wearable with the id 'wearer' is already running on domain "));
  EXPECT_THAT(second_ending.err, HasSubstr("stop it, or give this one another agent_id or --domain"));
  EXPECT_EQ(first->wait().exit_code, 0);
  EXPECT_EQ(robot_process->wait().exit_code, 0);
  const RunFiles run = run_files();
  EXPECT_THAT(run, IsCompleteToTheLastFrame(kFrames, small_scene()));
  EXPECT_EQ(run.summary("inbox.wearer_restarts"), 0);
  EXPECT_EQ(run.frames().back().at("worn_image"), "1");
}

TEST_F(Collaboration, AnInterruptEndsARobotSoonWithCompleteFiles) {
  const auto robot_process = robot(small_scene(), {"--wait-for-wearer", "0", "--rate", "0.5"});
  ASSERT_TRUE(robot_reaches(8));
  robot_process->send(SIGINT);
  const Ending ending = robot_process->wait(kSoon);
  EXPECT_EQ(ending.exit_code, 0) << ending.err;
  const RunFiles run = run_files();
  EXPECT_GE(run.frames().size(), 8U);
  EXPECT_LT(run.frames().size(), static_cast<std::size_t>(kFrames));
  EXPECT_EQ(run.trajectory().size(), run.frames_with_scale());
  EXPECT_EQ(run.summary("frames"), static_cast<int>(run.frames().size()));
  EXPECT_GT(std::filesystem::file_size(run_folder() / "map.ply"), 0U);
  EXPECT_GT(std::filesystem::file_size(run_folder() / "map.pcd"), 0U);
}

TEST_F(Collaboration, AnInterruptEndsARobotThatWaitsForItsWearer) {
  const auto robot_process = robot(small_scene(), {"--wait-for-wearer", "60"});
  ASSERT_TRUE(says(*robot_process, "waiting up to 60 s for a wearer"));
  robot_process->send(SIGINT);
  EXPECT_EQ(robot_process->wait(kSoon).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(run_folder() / "summary.yaml"));
}

TEST_F(Collaboration, AnInterruptEndsAWearerThatLoopsWithItsFigures) {
  const auto wearer_process = wearer(small_scene(), {"--wait-for-robot", "0", "--loop"});
  ASSERT_TRUE(says(*wearer_process, "wearable 'wearer' on domain"));
  wearer_process->send(SIGINT);
  const Ending ending = wearer_process->wait(kSoon);
  EXPECT_EQ(ending.exit_code, 0) << ending.err;
  EXPECT_THAT(ending.out, HasSubstr("frames_sent: "));
}

}  // namespace
}  // namespace cosight::integration
