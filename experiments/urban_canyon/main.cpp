#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "experiments/urban_canyon/courses.hpp"
#include "experiments/urban_canyon/pose_consistency.hpp"
#include "experiments/urban_canyon/study.hpp"
#include "experiments/urban_canyon/summary.hpp"
#include "shared/program/program.hpp"

namespace {

using namespace cosight;               // NOLINT(google-build-using-namespace): a program's own file
using namespace cosight::experiments;  // NOLINT(google-build-using-namespace)
namespace fs = std::filesystem;

struct Arguments {
  fs::path folder;
  int canyon = 1;
  int runs = 10;
  unsigned seed = 1;
  int threads = 2;
  double length = 0.0;
  fs::path tracks;
  bool readings = false;
  bool paper_noise = false;
  int consistency_runs = 0;
};

void add_options(CLI::App& app, Arguments& arguments) {
  app.add_option("--out", arguments.folder, "folder for the results")->required();
  app.add_option("--canyon", arguments.canyon, "1: by day, little traffic; 2: at night, dense traffic")
      ->check(CLI::Range(1, 2))
      ->capture_default_str();
  app.add_option("--runs", arguments.runs, "drives")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--seed", arguments.seed, "of the first drive")->capture_default_str();
  app.add_option("--threads", arguments.threads)->check(CLI::Range(1, 64))->capture_default_str();
  app.add_option("--length", arguments.length, "of a drive instead of the canyon's own [m]");
  app.add_option("--tracks", arguments.tracks,
                 "a recorded drive of this kind too: folder with cam.txt, imu.txt, …");
  app.add_flag("--readings", arguments.readings, "every reading of V26 and V30 instead of the five modes");
  app.add_flag("--paper-noise", arguments.paper_noise,
               "the window is told the paper's Table 1 noise, as densities, instead of the sensors' own");
  app.add_option("--consistency", arguments.consistency_runs,
                 "NEES of the pose over so many static drives too");
}

void report(const std::string& name, const MethodStudy& study, int paper_table, Summary& summary) {
  std::fputs((table(name, study, paper_table) + "\n").c_str(), stdout);
  std::fflush(stdout);  // the next one takes minutes
  const std::vector<MethodSummary> methods = summarise(study);
  for (std::size_t m = 0; m < methods.size(); ++m)
    summary.set(name, study.names[m], named(methods[m]));
}

/// The sensors that made the tracks, as their makers state them.
vins::TrackRunOptions window_for_tracks() {
  vins::TrackRunOptions options;
  options.noise = {
      .accelerometer = 1.15e-3, .gyroscope = 5.25e-4, .accelerometer_walk = 1e-4, .gyroscope_walk = 1e-5};
  options.window.solver.graph.trust.pixel_noise = 0.25;
  return options;
}

/// Table 1 of the paper, its IMU noise taken as densities: far more than the sensors have. The drives stay as
/// they are, only the window is told this.
void tell_paper_noise(vins::TrackRunOptions& window) {
  window.noise = {
      .accelerometer = 0.1, .gyroscope = 0.01, .accelerometer_walk = 0.001, .gyroscope_walk = 0.0001};
  window.window.solver.graph.trust.pixel_noise = 1.5;
}

void run_canyon(const Arguments& arguments, const Workers& workers, Summary& summary) {
  CanyonOptions canyon = arguments.canyon == 1 ? urban_canyon_1() : urban_canyon_2();
  if (arguments.length > 0.0) canyon.length = arguments.length;
  vins::TrackRunOptions window = window_for(canyon);
  if (arguments.paper_noise) tell_paper_noise(window);
  const vins::TrustOptions& trust = window.window.solver.graph.trust;
  const std::vector<Method> methods = arguments.readings ? readings(trust) : modes(trust);
  const std::string name = "urban_canyon_" + std::to_string(arguments.canyon);
  report(name, study_canyon(canyon, window, methods, arguments.seed, arguments.runs, workers),
         arguments.canyon + 1, summary);
  if (!arguments.readings) {
    write_courses(arguments.folder, make_canyon_drive(canyon, arguments.seed).sequence, window, methods);
  }
}

void run_recorded(const Arguments& arguments, const Workers& workers, Summary& summary) {
  vins::TrackRunOptions window = window_for_tracks();
  if (arguments.paper_noise) tell_paper_noise(window);
  const vins::TrustOptions& trust = window.window.solver.graph.trust;
  const std::vector<Method> methods = arguments.readings ? readings(trust) : modes(trust);
  report("urban_tracks_" + std::to_string(arguments.canyon),
         study_tracks(vins::read_track_sequence(arguments.tracks), window, methods, workers), 0, summary);
}

void run(const Arguments& arguments, const std::atomic<bool>& stop) {
  fs::create_directories(arguments.folder);
  const Workers workers(arguments.threads, stop);
  Summary summary;
  run_canyon(arguments, workers, summary);
  if (!arguments.tracks.empty()) run_recorded(arguments, workers, summary);
  if (arguments.consistency_runs > 0) {
    const std::vector<ModeConsistency> modes = study_consistency(arguments.consistency_runs, workers);
    std::fputs(table(modes, arguments.consistency_runs).c_str(), stdout);
    write_nees(arguments.folder, modes);
    for (const ModeConsistency& mode : modes)
      summary.set("vins_consistency", mode.name, named(mode));
  }
  summary.write(arguments.folder / "summary.json");
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      {.name = "experiment_urban_canyon",
       .purpose = "The adaptive VINS on drives through a simulated city, in each of its modes.",
       .examples =
           "  experiment_urban_canyon --canyon 2 --out runs/canyon_2 --runs 10\n"
           "  experiment_urban_canyon --canyon 1 --length 400 --runs 2 --readings --out runs/readings\n"
           "  experiment_urban_canyon --canyon 2 --length 600 --runs 4 --paper-noise --out "
           "runs/paper_noise\n"});
  Arguments arguments;
  add_options(program.command_line(), arguments);
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>& stop) {
    config.refuse_unknown_keys();
    run(arguments, stop);
    return ExitCode::kDone;
  });
}
