#include "tools/aggregate_command.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "shared/evaluation/error_statistics.hpp"
#include "shared/evaluation/evaluation_error.hpp"
#include "tools/evaluation_report.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct AggregateArguments {
  fs::path folder;
  std::vector<std::string> runs;
  std::vector<std::string> modes{"collaborative", "mono"};
  double diverged_percent = 20.0;
};

constexpr std::array kColumns{"final_error_m",
                              "mean_error_m",
                              "accumulated_error_m",
                              "final_rotation_error_deg",
                              "path_m",
                              "overlap_ratio",
                              "tau",
                              "kappa",
                              "u",
                              "pseudo_stereo_share",
                              "pseudo_stereo_time_percent"};

/// One run in one mode.
struct EvaluatedRun {
  std::string name;
  std::vector<Metric> metrics;
  bool diverged = false;

  std::optional<double> operator[](const std::string& metric) const {
    const auto at =
        std::find_if(metrics.begin(), metrics.end(), [&](const Metric& m) { return m.name == metric; });
    return at != metrics.end() ? at->value : std::nullopt;
  }
};

/// Ended far from where it should, did not end at all, or ended lost.
bool has_diverged(const EvaluatedRun& run, double limit_percent) {
  constexpr double kWholeRun = 95.0;  // [%] of the truth's poses since the start
  constexpr double kHalfRun = 50.0;   // [%] of all: a run that starts later says little
  return !(run["final_error_percent"].value_or(1e9) <= limit_percent) ||
         !(run["coverage_after_start_percent"].value_or(0.0) >= kWholeRun) ||
         !(run["coverage_percent"].value_or(0.0) >= kHalfRun) || run["lost_at_end"].value_or(0.0) > 0.0;
}

std::vector<EvaluatedRun> read_runs(const AggregateArguments& arguments, const std::string& mode) {
  std::vector<EvaluatedRun> runs;
  for (const std::string& name : arguments.runs) {
    EvaluatedRun run{name, read_metrics_json(arguments.folder / name / mode / "evaluation.json")};
    run.diverged = has_diverged(run, arguments.diverged_percent);
    runs.push_back(std::move(run));
  }
  return runs;
}

std::vector<double> values_of(const std::vector<EvaluatedRun>& runs, const std::string& metric) {
  std::vector<double> values;
  for (const EvaluatedRun& run : runs) {
    if (const auto value = run[metric]) values.push_back(*value);
  }
  return values;
}

Json summary_of(const std::vector<EvaluatedRun>& runs) {
  const auto final_errors = statistics_of(values_of(runs, "final_error_m"));
  const auto rotations = statistics_of(values_of(runs, "final_rotation_error_deg"));
  Json summary;
  summary["runs"] = runs.size();
  summary["diverged"] = std::count_if(runs.begin(), runs.end(), [](const auto& run) { return run.diverged; });
  summary["final_error_m_mean"] = final_errors.mean;
  summary["final_error_m_median"] = final_errors.median;
  summary["final_error_m_max"] = final_errors.max;
  summary["error_m_mean"] = statistics_of(values_of(runs, "mean_error_m")).mean;
  summary["accumulated_error_m_mean"] = statistics_of(values_of(runs, "accumulated_error_m")).mean;
  summary["heading_error_deg_mean"] = rotations.mean;
  summary["heading_error_deg_max"] = rotations.max;
  summary["overlap_ratio_mean"] = statistics_of(values_of(runs, "overlap_ratio")).mean;
  return summary;
}

std::string text_of(const std::optional<double>& value) {
  if (!value) return "n/a";
  std::ostringstream text;
  text << std::setprecision(4) << *value;
  return text.str();
}

void append_rows(std::ostream& csv, const std::string& mode, const std::vector<EvaluatedRun>& runs) {
  for (const EvaluatedRun& run : runs) {
    csv << run.name << ',' << mode;
    for (const char* column : kColumns)
      csv << ',' << (run[column] ? text_of(run[column]) : "");
    csv << ',' << (run.diverged ? 1 : 0) << '\n';
  }
}

void print_rows(const std::string& mode, const std::vector<EvaluatedRun>& runs, const Json& summary) {
  constexpr int kName = 18;
  constexpr int kWidth = 13;
  std::cout << mode << '\n' << std::left << std::setw(kName) << "run" << std::right;
  for (const char* head : {"final [m]", "mean [m]", "rotation [deg]", "overlap", "tau", "kappa", "U"})
    std::cout << std::setw(kWidth + (std::string_view(head).size() > 12 ? 3 : 0)) << head;
  for (const EvaluatedRun& run : runs) {
    std::cout << '\n' << std::left << std::setw(kName) << run.name << std::right;
    for (const char* metric : {"final_error_m", "mean_error_m", "final_rotation_error_deg", "overlap_ratio",
                               "tau", "kappa", "u"}) {
      std::cout << std::setw(kWidth + (std::string_view(metric) == "final_rotation_error_deg" ? 3 : 0))
                << text_of(run[metric]);
    }
    if (run.diverged) std::cout << "  diverged";
  }
  std::cout << "\n  final error: mean " << text_of(summary["final_error_m_mean"].get<double>()) << ", median "
            << text_of(summary["final_error_m_median"].get<double>()) << ", worst "
            << text_of(summary["final_error_m_max"].get<double>()) << " m; diverged " << summary["diverged"]
            << " of " << runs.size() << "\n\n";
}

void run(const AggregateArguments& arguments) {
  std::ofstream csv(arguments.folder / "runs.csv");
  csv << "run,mode";
  for (const char* column : kColumns)
    csv << ',' << column;
  csv << ",diverged\n";
  Json summary = Json::object();
  for (const std::string& mode : arguments.modes) {
    const std::vector<EvaluatedRun> runs = read_runs(arguments, mode);
    summary[mode] = summary_of(runs);
    append_rows(csv, mode, runs);
    print_rows(mode, runs, summary[mode]);
  }
  std::ofstream json(arguments.folder / "summary.json");
  json << summary.dump(2) << '\n';
  csv.close();
  json.close();
  if (!csv || !json)
    throw EvaluationError(arguments.folder.string() + ": runs.csv or summary.json cannot be written");
}

}  // namespace

void add_aggregate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "aggregate", "Gather many evaluated runs, each in several modes, into one table");
  const auto arguments = std::make_shared<AggregateArguments>();
  command->add_option("DIR", arguments->folder, "Folder with RUN/MODE/evaluation.json")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("RUN", arguments->runs, "Runs, in the order of the table")->required();
  command->add_option("--modes", arguments->modes, "Modes of each run")
      ->delimiter(',')
      ->capture_default_str();
  command
      ->add_option("--diverged-percent", arguments->diverged_percent,
                   "A final error of more of the path counts as diverged")
      ->capture_default_str();
  command->footer("Example: cosight aggregate build/experiments/corridor corridor_01 corridor_02");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
