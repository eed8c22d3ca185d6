#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "experiments/consistency/monte_carlo.hpp"
#include "experiments/csv_file.hpp"
#include "experiments/figures.hpp"
#include "shared/program/program.hpp"

namespace {

using namespace cosight;               // NOLINT(google-build-using-namespace): a program's own file
using namespace cosight::experiments;  // NOLINT(google-build-using-namespace)
namespace fs = std::filesystem;

struct Mode {
  const char* name;
  RunOptions options;
};

std::vector<Mode> modes() {
  std::vector<Mode> all;
  const auto add = [&all](const char* name, auto change) {
    Mode mode{name, {}};
    change(mode.options);
    all.push_back(mode);
  };
  add("collaborative", [](RunOptions&) {});
  add("mono", [](RunOptions& o) { o.last_glance = 5; });
  add("always", [](RunOptions& o) { o.glance_steps = o.glance_period; });
  add("room", [](RunOptions& o) {
    o.world.shape = WorldShape::kBox;
    o.world.sigma_acceleration = 0.2;
    o.world.sigma_angular_acceleration = 0.1;
  });
  add("independent_updates", [](RunOptions& o) { o.filter.correlated_wearer_pose = false; });
  add("independent_starts", [](RunOptions& o) { o.correlated_starts = false; });
  add("iterated", [](RunOptions& o) { o.filter.max_iterations = 4; });
  add("points", [](RunOptions& o) { o.wearer_form = WearerForm::kPoint; });
  add("points_in_metres", [](RunOptions& o) {
    o.wearer_form = WearerForm::kPoint;
    o.filter.point_form = ekf::PointForm::kEuclidean;
  });
  add("paper", [](RunOptions& o) {
    o.wearer_form = WearerForm::kPoint;
    o.filter.point_form = ekf::PointForm::kEuclidean;
    o.filter.correlated_wearer_pose = false;
    o.correlated_starts = false;
    o.first_pose = FirstPose::kIndependent;
  });
  add("overconfident", [](RunOptions& o) { o.claimed_variance = 1.0 / 3.0; });
  for (const WearerForm form : {WearerForm::kPixel, WearerForm::kPoint}) {
    add(form == WearerForm::kPixel ? "wide_noise" : "wide_noise_points", [form](RunOptions& o) {
      o.wearer_form = form;
      o.world.wearer_sigma_p = 0.05;
      o.world.wearer_sigma_theta = 2.0 * std::numbers::pi / 180.0;
    });
  }
  return all;
}

void write_course(const fs::path& file, const RunOptions& options, const ConsistencyCourse& course) {
  CsvFile csv(file, "t,pose_nees,position_nees,nis_pixel,nis_point,nis_joint,position_error");
  for (std::size_t k = 0; k < course.mean.size(); ++k) {
    const StepResult& step = course.mean[k];
    csv.row({options.world.dt * static_cast<double>(k + 1), step.pose_nees, step.position_nees,
             step.pixels.mean_per_row(), step.points.mean_per_row(), step.joint.mean_per_row(),
             step.position_error});
  }
  csv.close();
}

/// 30 % of the matches are wrong, each off by its own 5 to 40 px or all of a frame by the same.
void run_association(int runs, Figures& figures) {
  struct Way {
    const char* name;
    Validation validation;
  };
  constexpr std::array<Way, 5> kWays{{{"gate", Validation::kGate},
                                      {"hohct", Validation::kHohct},
                                      {"hohct_then_each", Validation::kHohctThenEach},
                                      {"jcbb", Validation::kJcbb},
                                      {"ransac", Validation::kOnePointRansac}}};
  RunOptions options;
  options.validation = Validation::kHohctThenEach;
  const ConsistencyCourse clean = monte_carlo(options, runs);
  summarise_matches(clean, "clean", figures);
  const double clean_error = mean_final_error(clean);
  options.wrong.share = 0.3;
  for (const bool repeated : {false, true}) {
    options.wrong.repeated = repeated;
    for (const Way& way : kWays) {
      options.validation = way.validation;
      const ConsistencyCourse course = monte_carlo(options, runs);
      const std::string name = std::string(repeated ? "repeated_" : "association_") + way.name;
      const std::string mode = name == "association_hohct_then_each" ? "association" : name;
      summarise_matches(course, mode, figures);
      figures.set(mode, "error_ratio", mean_final_error(course) / clean_error);
    }
  }
}

void run(const fs::path& folder, int runs) {
  constexpr int kAssociationRuns = 20;  // enough: each has a thousand matches
  fs::create_directories(folder);
  Figures figures;
  for (const Mode& mode : modes()) {
    const ConsistencyCourse course = monte_carlo(mode.options, runs);
    write_course(folder / (std::string("nees_") + mode.name + ".csv"), mode.options, course);
    summarise(course, mode.name, figures);
  }
  std::fputs(figures.table().c_str(), stdout);
  Figures association;
  run_association(std::min(runs, kAssociationRuns), association);
  std::printf("\n%s", association.table().c_str());
  figures.append(association);
  figures.write_summary(folder);
}

}  // namespace

int main(int argc, char** argv) {
  Program program({.name = "experiment_consistency",
                   .purpose = "Is the filter as wrong as it says? Monte Carlo with exact truth.",
                   .examples = "  experiment_consistency --out runs/consistency\n"});
  fs::path folder;
  int runs = 50;
  program.command_line().add_option("--out", folder, "folder for the results")->required();
  program.command_line()
      .add_option("--runs", runs, "Monte Carlo runs of each mode")
      ->check(CLI::Range(1, 10'000))
      ->capture_default_str();
  return program.run(argc, argv, [&](const ConfigFile& config, const std::atomic<bool>&) {
    config.refuse_unknown_keys();
    run(folder, runs);
    return ExitCode::kDone;
  });
}
