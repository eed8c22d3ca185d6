#include <spdlog/spdlog.h>

#include <cstdio>

#include "robot_agent/offline_run.hpp"
#include "robot_agent/robot_agent.hpp"
#include "shared/program/agent_options.hpp"
#include "shared/program/program.hpp"
#include "shared/program/status_line.hpp"

namespace {

using namespace cosight;  // NOLINT(google-build-using-namespace): a program's own file

const char* mode_of(const robot::RobotOptions& options) {
  if (!robot::has_slam(options.estimators)) return "vins";
  return options.slam.mode == slam::Mode::kMono ? "mono" : "collaborative";
}

/// Live or offline.
template <class Agent>
ExitCode run_to_the_end(Agent& agent) {
  StatusLine status;
  const auto problems = agent.run([&](const std::string& line) {
    if (status.is_visible()) status.show(line);
  });
  status.clear();
  for (const std::string& problem : problems)
    spdlog::warn("{}", problem);
  std::printf("%s\n", agent.run_folder().c_str());
  return problems.empty() ? ExitCode::kDone : ExitCode::kDataLost;
}

ExitCode run(const ConfigFile& config, const std::atomic<bool>& stop) {
  const auto options = robot::read_robot_options(config.root());
  config.refuse_unknown_keys();
  const outbox::RunDescription description{COSIGHT_VERSION, mode_of(options), config.resolved(),
                                           robot::has_slam(options.estimators)};
  if (options.input.recording.empty()) {
    robot::RobotAgent agent(options, description, stop);
    return run_to_the_end(agent);
  }
  robot::OfflineRun agent(options, description, stop);
  return run_to_the_end(agent);
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      {.name = "robot_agent",
       .purpose = "Maps and locates a robot with one camera and the glances of a person's.",
       .examples =
           "  robot_agent --dataset build/demo/dataset\n"
           "  robot_agent --dataset build/demo/dataset --mode mono --run-dir runs/mono\n"
           "  robot_agent --from-topics --set input.lasers=lasers.yaml --calibration camera.yaml\n"
           "  robot_agent --config config/robot.yaml --device /dev/video0 --calibration camera.yaml\n"});
  add_agent_options(program)
      .option("--mode", "slam.mode", "collaborative, or mono: without the wearer once the scale is set")
      .flag("--from-topics", "input.topics",
            "sensors that others publish; --dataset then only says how it is built")
      .option(
          "--from", "input.recording",
          "MCAP recording, without DDS; with --rate 0 as fast as possible; --dataset as for --from-topics")
      .option("--only", "only", "vins: without slam; slam: without vins")
      .option("--wearer-pose", "wearer.pose_from", "where the wearer is: tracker, laser or auto")
      .option("--run-dir", "run_dir", "folder for trajectory, map, log and summary")
      .option("--wait-for-wearer", "start.wait_for_wearer",
              "seconds to wait for a wearer before the first frame");
  return program.run(argc, argv, run);
}
