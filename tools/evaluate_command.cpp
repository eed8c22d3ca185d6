#include "tools/evaluate_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "shared/evaluation/evaluation.hpp"
#include "shared/evaluation/evaluation_error.hpp"
#include "shared/evaluation/trajectory_reader.hpp"
#include "tools/evaluation_report.hpp"
#include "tools/trajectory_plot.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  fs::path estimate;
  fs::path truth;
  fs::path times;
  fs::path frames;
  fs::path covariances;
  fs::path out;
  fs::path json;
  std::string name = "estimate";
  std::string alignment = "none";
  double max_difference_s = 0.01;
  double truth_offset_s = 0.0;
  double delta = 1.0;
  std::string delta_unit = "frames";
  bool all_pairs = false;
  bool plot = false;
};

EvaluationOptions options_of(const EvaluateArguments& arguments) {
  EvaluationOptions options;
  options.alignment = alignment_from(arguments.alignment).value();
  options.max_difference = from_seconds(arguments.max_difference_s);
  options.truth_offset = from_seconds(arguments.truth_offset_s);
  options.relative = {arguments.delta, delta_unit_from(arguments.delta_unit).value(), arguments.all_pairs};
  return options;
}

void write_results(const EvaluateArguments& arguments, const Evaluation& evaluation) {
  if (!arguments.json.empty()) write_metrics_json(arguments.json, evaluation.metrics);
  if (arguments.out.empty()) return;
  fs::create_directories(arguments.out);
  const fs::path errors = arguments.out / "errors.csv";
  write_errors_csv(errors, evaluation);
  write_metrics_json(arguments.out / "evaluation.json", evaluation.metrics);
  const std::string title = arguments.name + " against truth, alignment " + arguments.alignment;
  if (arguments.plot &&
      !plot_trajectories(arguments.out / "trajectory.png", title, {{arguments.name, errors}})) {
    std::cerr << "cosight evaluate: gnuplot made no picture; is the package gnuplot-nox installed?\n";
  }
}

void run(const EvaluateArguments& arguments) {
  if (arguments.plot && arguments.out.empty()) throw EvaluationError("--plot needs --out DIR to write into");
  const Trajectory estimate = read_trajectory(arguments.estimate, arguments.times);
  const Trajectory truth = read_trajectory(arguments.truth, arguments.times);
  std::vector<FrameRecord> frames;
  if (!arguments.frames.empty()) frames = read_frame_log(arguments.frames);
  CovarianceLog covariances;
  if (!arguments.covariances.empty()) covariances = read_covariance_log(arguments.covariances);
  const Evaluation evaluation = evaluate(estimate, truth, options_of(arguments), frames, covariances);
  write_results(arguments, evaluation);
  std::cout << metrics_table(evaluation.metrics);
}

void add_comparison_options(CLI::App& command, EvaluateArguments& arguments) {
  command.add_option("--align", arguments.alignment, "How the estimate is laid onto the truth first")
      ->check(CLI::IsMember({"none", "first_pose", "se3", "sim3"}))
      ->capture_default_str();
  command.add_option("--max-difference-s", arguments.max_difference_s, "Farthest truth in time")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--truth-offset-s", arguments.truth_offset_s, "Added to the truth's times")
      ->capture_default_str();
  command.add_option("--delta", arguments.delta, "Step of the relative pose error")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command.add_option("--delta-unit", arguments.delta_unit, "Unit of that step")
      ->check(CLI::IsMember({"frames", "metres", "seconds"}))
      ->capture_default_str();
  command.add_flag("--all-pairs", arguments.all_pairs,
                   "Relative errors from every frame, not every delta-th");
}

void add_file_options(CLI::App& command, EvaluateArguments& arguments) {
  command.add_option("ESTIMATE", arguments.estimate, "Trajectory: TUM, EuRoC csv or KITTI")->required();
  command.add_option("TRUTH", arguments.truth, "Trajectory to compare with")->required();
  command.add_option("--times", arguments.times, "Times of KITTI rows [s a line]");
  command.add_option("--frames", arguments.frames, "frames.csv of the run: overlap, landmarks, times");
  command.add_option("--covariances", arguments.covariances, "csv stamp_ns,c00,c01,…,c55: gives the NEES");
  command.add_option("--out", arguments.out, "Folder for errors.csv, evaluation.json and the picture");
  command.add_flag("--plot", arguments.plot, "Draw trajectory.png into --out (gnuplot)");
  command.add_option("--json", arguments.json, "Write the metrics to this file too");
  command.add_option("--name", arguments.name, "Name of the run in the picture")->capture_default_str();
}

}  // namespace

void add_evaluate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("evaluate", "Compare a trajectory with its truth");
  const auto arguments = std::make_shared<EvaluateArguments>();
  add_file_options(*command, *arguments);
  add_comparison_options(*command, *arguments);
  command->footer(
      "Example: cosight evaluate runs/latest/trajectory.tum data/truth/robot_cam0.tum --align se3 "
      "--frames runs/latest/frames.csv --out runs/latest --plot");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
