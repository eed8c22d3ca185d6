#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <string>

#include "shared/program/program.hpp"
#include "shared/recording/dataset_recording.hpp"
#include "shared/transport/participant_config.hpp"
#include "sim/live.hpp"
#include "sim/scenario_file.hpp"
#include "sim/simulation.hpp"

namespace {

using namespace cosight;  // NOLINT(google-build-using-namespace): a program's own file

/// What is asked for besides the scene.
struct Wish {
  std::string folder;
  std::string recording;
  sim::RunOptions run;
  bool live = false;
  sim::LiveOptions stream;
};

void add_options(CLI::App& app, Wish& wish) {
  app.add_option("--out", wish.folder, "folder for the dataset; with --live for everything but the pictures");
  app.add_option("--record", wish.recording, "with --out: an MCAP recording of it too");
  app.add_option("--seed", wish.run.seed, "the same seed gives the same bytes")->capture_default_str();
  app.add_option("--threads", wish.run.threads, "that render; the pictures are the same with any number")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  app.add_flag("--frames,!--no-frames", wish.run.with_frames, "render pictures, not only the other sensors");
  app.add_flag("--live", wish.live, "publish both agents' sensors over DDS, in the rhythm of their stamps");
  app.add_option("--rate", wish.stream.rate, "with --live: times real time")
      ->check(CLI::Range(0.01, 100.0))
      ->capture_default_str();
  app.add_option("--wait", wish.stream.wait,
                 "with --live: seconds to wait for a robot before the first frame")
      ->check(CLI::Range(0.0, 86'400.0))
      ->capture_default_str();
  app.add_flag("--tracker", wish.stream.tracks_wearer,
               "with --live: publish the worn camera's tracked pose too");
}

ExitCode write(const sim::SimulatedRun& run, const Wish& wish, const std::atomic<bool>& stop) {
  const auto start = std::chrono::steady_clock::now();
  const sim::RunReport report = sim::write_dataset(run, wish.run, wish.folder, stop);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%s: %zu + %zu frames, %.1f s of world in %.1f s, overlap ratio %.3f, %zu known points -> %s\n",
              run.scenario().name.c_str(), report.robot_frames, report.wearer_frames, report.duration,
              took.count(), report.overlap_ratio, report.known_points, wish.folder.c_str());
  if (report.stopped) spdlog::warn("stopped: {} lacks pictures", wish.folder);
  if (!wish.recording.empty() && !report.stopped) recording::record_dataset(wish.folder, wish.recording);
  return report.stopped ? ExitCode::kDataLost : ExitCode::kDone;
}

ExitCode drive(const sim::CityScenario& scenario, const Wish& wish, const std::atomic<bool>& stop) {
  const auto start = std::chrono::steady_clock::now();
  const sim::CityRun run(scenario, wish.run.seed);
  const sim::RunReport report = sim::write_dataset(run, wish.run, wish.folder, stop);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%s: %zu frames, %.0f m, %zu vehicles, %.1f s of world in %.1f s -> %s\n",
              scenario.name.c_str(), report.robot_frames, scenario.length, run.traffic().size(),
              report.duration, took.count(), wish.folder.c_str());
  if (report.stopped) spdlog::warn("stopped: {} lacks pictures", wish.folder);
  return report.stopped ? ExitCode::kDataLost : ExitCode::kDone;
}

ExitCode play(const sim::SimulatedRun& run, const Wish& wish, const std::atomic<bool>& stop) {
  spdlog::info("waiting up to {:g} s for a robot on domain {} (robot_agent --from-topics)", wish.stream.wait,
               wish.stream.dds.domain);
  const sim::LiveReport report = sim::play_live(run, wish.stream, stop);
  if (!report.had_readers) spdlog::warn("nobody read both cameras' frames when they began");
  for (const auto& [name, stream] : {std::pair{"robot", report.robot}, std::pair{"wearer", report.wearer}}) {
    std::printf("%s: %llu samples, %llu frames, %llu late, at worst by %.3f s\n", name,
                static_cast<unsigned long long>(stream.samples),
                static_cast<unsigned long long>(stream.frames), static_cast<unsigned long long>(stream.late),
                stream.worst_lateness);
  }
  if (report.robot.late + report.wearer.late > 0) {
    spdlog::warn("frames were late: take a lower --rate, smaller pictures, or more --threads");
  }
  return stop ? ExitCode::kDataLost : ExitCode::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      {.name = "sim",
       .purpose = "Renders a scene with both agents, into a Cosight dataset folder or live to DDS.",
       .examples =
           "  sim --config config/scenes/corridor_turn.yaml --out runs/turn --seed 1\n"
           "  sim --config config/scenes/room.yaml --out runs/room --set robot.path.speed_mps=0.5\n"
           "  sim --config config/scenes/corridor_turn.yaml --live --out runs/turn --domain 7\n"
           "  sim --config config/scenes/urban_canyon_1.yaml --out runs/canyon --set city.length_m=200\n"});
  Wish wish;
  add_options(program.command_line(), wish);
  program.option("--domain", "dds.domain", "with --live: DDS domain, 0 to 232");
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>& stop) {
    if (sim::is_city(config.root())) {
      const sim::CityScenario city = sim::read_city_scenario(config.root());
      config.refuse_unknown_keys();
      if (wish.folder.empty() || wish.live)
        throw ConfigError("a city is driven into a folder: give --out, not --live");
      return drive(city, wish, stop);
    }
    const sim::Scenario scenario = sim::read_scenario(config.root());
    wish.stream.dds = transport::read_participant_options(config.root().section("dds"), {});
    config.refuse_unknown_keys();
    if (wish.folder.empty() && !wish.live) throw ConfigError("--out is missing: where is the dataset to go?");
    wish.run.with_frames &= !wish.live;
    wish.stream.threads = wish.run.threads;
    const sim::SimulatedRun run(scenario, wish.run.seed);
    if (!wish.folder.empty()) {
      const ExitCode code = write(run, wish, stop);
      if (!wish.live || code != ExitCode::kDone) return code;
    }
    return play(run, wish, stop);
  });
}
