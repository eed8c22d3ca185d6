#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "shared/program/program.hpp"
#include "sim/scenario_file.hpp"
#include "sim/simulation.hpp"

int main(int argc, char** argv) {
  using namespace cosight;  // NOLINT(google-build-using-namespace): a program's own file
  Program program(
      {.name = "sim",
       .purpose = "Renders a scene with both agents into a Cosight dataset folder.",
       .examples =
           "  sim --config config/scenes/corridor_turn.yaml --out runs/turn --seed 1\n"
           "  sim --config config/scenes/room.yaml --out runs/room --set robot.path.speed_mps=0.5\n"});
  std::string folder;
  sim::RunOptions options;
  program.command_line().add_option("--out", folder, "folder for the dataset")->required();
  program.command_line()
      .add_option("--seed", options.seed, "the same seed gives the same bytes")
      ->capture_default_str();
  program.command_line()
      .add_option("--threads", options.threads, "that render; the pictures are the same with any number")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  program.command_line().add_flag("--frames,!--no-frames", options.with_frames,
                                  "render pictures, not only the other sensors");
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>& stop) {
    const sim::Scenario scenario = sim::read_scenario(config.root());
    config.refuse_unknown_keys();
    const auto start = std::chrono::steady_clock::now();
    const sim::RunReport report = sim::write_dataset(scenario, options, folder, stop);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf(
        "%s: %zu + %zu frames, %.1f s of world in %.1f s, overlap ratio %.3f, %zu known points -> %s\n",
        scenario.name.c_str(), report.robot_frames, report.wearer_frames, report.duration, took.count(),
        report.overlap_ratio, report.known_points, folder.c_str());
    return report.stopped ? ExitCode::kDataLost : ExitCode::kDone;
  });
}
