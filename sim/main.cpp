#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/scenario_file.hpp"
#include "sim/simulation.hpp"

namespace {

std::atomic<bool> stop_requested{false};

void request_stop(int /*signal*/) {
  stop_requested = true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Renders a scene with both agents into a Cosight dataset folder");
  std::string scene;
  std::string folder;
  std::vector<std::string> settings;
  cosight::sim::RunOptions options;
  bool no_frames = false;
  app.add_option("--config", scene, "Scene file, as in config/scenes/")->required();
  app.add_option("--out", folder, "Folder for the dataset")->required();
  app.add_option("--seed", options.seed, "The same seed gives the same bytes")->capture_default_str();
  app.add_option("--threads", options.threads, "Rendering threads")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_option("--set", settings, "KEY=VALUE that replaces the scene file's");
  app.add_flag("--no-frames", no_frames, "Everything but the pictures");
  app.footer("Example: sim --config config/scenes/corridor_turn.yaml --out /tmp/turn --seed 1");
  CLI11_PARSE(app, argc, argv);
  options.with_frames = !no_frames;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  try {
    std::vector<cosight::ConfigOverride> overrides;
    for (const std::string& setting : settings)
      overrides.push_back(cosight::parse_override(setting));
    const cosight::sim::Scenario scenario = cosight::sim::load_scenario(scene, overrides);
    const auto start = std::chrono::steady_clock::now();
    const cosight::sim::RunReport report =
        cosight::sim::write_dataset(scenario, options, folder, stop_requested);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    std::printf(
        "%s: %zu + %zu frames, %.1f s of world in %.1f s, overlap ratio %.3f, %zu known points -> %s\n",
        scenario.name.c_str(), report.robot_frames, report.wearer_frames, report.duration, took.count(),
        report.overlap_ratio, report.known_points, folder.c_str());
    return report.stopped ? 1 : 0;
  } catch (const cosight::ConfigError& error) {
    std::fprintf(stderr, "sim: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "sim: %s\n", error.what());
    return 1;
  }
}
