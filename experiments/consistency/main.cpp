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
  std::string name;
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
  add("real_association", [](RunOptions& o) {
    o.validation = Validation::kHohctThenEach;
    o.wrong.share = 0.3;
  });
  return all;
}

/// How the error of T_SF is treated: the paper's way, as noise of pixels, as a state.
struct Treatment {
  const char* name;
  WearerForm form;
  bool is_state;
  int iterations;
};
constexpr std::array<Treatment, 4> kTreatments{{{"points", WearerForm::kPoint, false, 1},
                                                {"pixels", WearerForm::kPixel, false, 1},
                                                {"state", WearerForm::kPixel, true, 1},
                                                {"state_iterated", WearerForm::kPixel, true, 4}}};

/// An error of T_SF that is wide, or wanders, or both, in each treatment; the state is told how it wanders.
std::vector<Mode> rig_error_modes() {
  struct Error {
    const char* name;
    double sigma_p;      ///< [m]
    double sigma_theta;  ///< [deg]
    double time;         ///< [s] 0: white
  };
  constexpr std::array<Error, 6> kErrors{{{"wide", 0.05, 2.0, 0.0},
                                          {"wide_1s", 0.05, 2.0, 1.0},
                                          {"wide_3s", 0.05, 2.0, 3.0},
                                          {"wide_10s", 0.05, 2.0, 10.0},
                                          {"narrow_3s", 0.02, 0.29, 3.0},
                                          {"turned_3s", 0.01, 2.0, 3.0}}};
  std::vector<Mode> all;
  for (const Error& error : kErrors) {
    for (const Treatment& treatment : kTreatments) {
      RunOptions o;
      o.world.wearer_sigma_p = error.sigma_p;
      o.world.wearer_sigma_theta = error.sigma_theta * std::numbers::pi / 180.0;
      o.world.wearer_error_time = error.time;
      o.wearer_form = treatment.form;
      o.filter.rig_error = {treatment.is_state, error.time, 0.0};
      o.filter.max_iterations = treatment.iterations;
      all.push_back({std::string(error.name) + "_" + treatment.name, o});
    }
  }
  // A state that is told the wrong thing: 3 s of a white error, with all of it or half of it believed to
  // wander.
  for (const double white_share : {0.0, 0.5}) {
    Mode told_wrong = all[2];
    told_wrong.name = white_share > 0.0 ? "wide_state_told_half_3s" : "wide_state_told_3s";
    told_wrong.options.filter.rig_error = {true, 3.0, white_share};
    all.push_back(told_wrong);
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

/// Runs the modes, writes their courses, and prints and adds up their figures.
void run_modes(const std::vector<Mode>& modes, int runs, const fs::path& folder, Figures& all) {
  Figures figures;
  for (const Mode& mode : modes) {
    const ConsistencyCourse course = monte_carlo(mode.options, runs);
    write_course(folder / ("nees_" + mode.name + ".csv"), mode.options, course);
    summarise(course, mode.name, figures);
    if (mode.options.wrong.share > 0.0) summarise_matches(course, mode.name, figures);
  }
  std::printf("%s\n", figures.table().c_str());
  all.append(figures);
}

void run(const fs::path& folder, int runs) {
  constexpr int kAssociationRuns = 20;  // enough: each has a thousand matches
  fs::create_directories(folder);
  Figures figures;
  run_modes(modes(), runs, folder, figures);
  run_modes(rig_error_modes(), runs, folder, figures);
  Figures association;
  run_association(std::min(runs, kAssociationRuns), association);
  std::fputs(association.table().c_str(), stdout);
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
