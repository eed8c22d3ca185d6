#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "experiments/csv_file.hpp"
#include "experiments/figures.hpp"
#include "experiments/planar/study.hpp"
#include "experiments/planar/trial.hpp"
#include "shared/program/program.hpp"

namespace {

using namespace cosight;               // NOLINT(google-build-using-namespace): a program's own file
using namespace cosight::experiments;  // NOLINT(google-build-using-namespace)
namespace fs = std::filesystem;

struct Arguments {
  fs::path folder;
  unsigned seed = 1;
  int runs = 20;
};

constexpr std::array<double, 7> kRangeSigmas{0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0};  // [m]

void write_run(const fs::path& folder, const std::string& mode, const TrialResult& trial) {
  CsvFile path(folder / ("run_" + mode + ".csv"), "t,true_x,true_z,x,z,position_sigma");
  for (const TrialStep& step : trial.steps) {
    path.row({step.t, step.truth.p.x(), step.truth.p.y(), step.estimate.p.x(), step.estimate.p.y(),
              step.position_sigma});
  }
  path.close();
  CsvFile map(folder / ("map_" + mode + ".csv"), "true_x,true_z,x,z");
  for (const PlanarFilter::Landmark& landmark : trial.map) {
    const Eigen::Vector2d& truth = trial.true_landmarks[static_cast<std::size_t>(landmark.id)];
    map.row({truth.x(), truth.y(), landmark.point.x(), landmark.point.y()});
  }
  map.close();
}

void write_courses(const fs::path& file, const MeanCourse& mono, const MeanCourse& collaborative) {
  CsvFile csv(file,
              "t,scale_mono,scale_collaborative,position_mono,position_collaborative,sigma_mono,"
              "sigma_collaborative");
  for (std::size_t k = 0; k < mono.t.size(); ++k) {
    csv.row({mono.t[k], mono.scale_error[k], collaborative.scale_error[k], mono.position_error[k],
             collaborative.position_error[k], mono.position_sigma[k], collaborative.position_sigma[k]});
  }
  csv.close();
}

void write_runs(const fs::path& file, const std::vector<TrialResult>& mono,
                const std::vector<TrialResult>& collaborative) {
  CsvFile csv(file, "run,final_error_mono,final_error_collaborative");
  for (std::size_t i = 0; i < mono.size(); ++i) {
    csv.row({static_cast<double>(i), mono[i].steps.back().position_error,
             collaborative[i].steps.back().position_error});
  }
  csv.close();
}

/// Figures 9 and 10: the same runs with other range noises.
void sweep_range_noise(const Arguments& arguments, TrialOptions options, Figures& figures) {
  std::vector<double> sigmas;
  std::vector<double> errors;
  CsvFile courses(arguments.folder / "sweep.csv", "range_sigma,t,position_error");
  CsvFile summary(arguments.folder / "correlation.csv", "range_sigma,error_mean,final_error_mean,sigma_mean");
  for (const double sigma : kRangeSigmas) {
    options.world.range_sigma = sigma;
    const MeanCourse course = mean_course(run_trials(options, arguments.seed, arguments.runs));
    double error = 0.0;
    double claimed = 0.0;
    const double steps = static_cast<double>(course.t.size());
    for (std::size_t k = 0; k < course.t.size(); ++k) {
      courses.row({sigma, course.t[k], course.position_error[k]});
      error += course.position_error[k] / steps;
      claimed += course.position_sigma[k] / steps;
    }
    summary.row({sigma, error, course.position_error.back(), claimed});
    sigmas.push_back(sigma);
    errors.push_back(error);
  }
  courses.close();
  summary.close();
  figures.set("range_sigma_sweep", "error_m_mean_at_0.25_m", errors.front());
  figures.set("range_sigma_sweep", "error_m_mean_at_1_m", errors.back());
  figures.set("range_sigma_sweep", "correlation", correlation(sigmas, errors));
}

void run(const Arguments& arguments) {
  fs::create_directories(arguments.folder);
  TrialOptions options;
  const auto collaborative = run_trials(options, arguments.seed, arguments.runs);
  options.collaborative = false;
  const auto mono = run_trials(options, arguments.seed, arguments.runs);
  options.collaborative = true;

  Figures figures;
  summarise(collaborative, options.world, "collaborative", figures);
  summarise(mono, options.world, "mono", figures);
  sweep_range_noise(arguments, options, figures);
  write_courses(arguments.folder / "errors.csv", mean_course(mono), mean_course(collaborative));
  write_runs(arguments.folder / "runs.csv", mono, collaborative);
  const TrialResult& typical = median_trial(mono);
  write_run(arguments.folder, "mono", typical);
  write_run(arguments.folder, "collaborative",
            collaborative[static_cast<std::size_t>(&typical - mono.data())]);
  figures.write_summary(arguments.folder);
  std::fputs(figures.table().c_str(), stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Program program({.name = "experiment_planar",
                   .purpose = "Planar collaborative EKF SLAM along a wall, with and without pseudo-stereo.",
                   .examples = "  experiment_planar --out runs/planar --runs 20 --seed 1\n"});
  Arguments arguments;
  program.command_line().add_option("--out", arguments.folder, "folder for the results")->required();
  program.command_line()
      .add_option("--runs", arguments.runs, "Monte Carlo runs of each setup")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  program.command_line().add_option("--seed", arguments.seed, "of the first run")->capture_default_str();
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>&) {
    config.refuse_unknown_keys();
    run(arguments);
    return ExitCode::kDone;
  });
}
