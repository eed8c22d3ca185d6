#include "tools/summarise_command.hpp"

#include <fstream>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "shared/config/config.hpp"
#include "shared/evaluation/evaluation_error.hpp"
#include "tools/evaluation_report.hpp"
#include "tools/trajectory_plot.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct SummariseArguments {
  fs::path folder;
  std::vector<std::string> modes;
  std::vector<std::string> metrics{
      "ate_m",         "final_error_m",    "final_error_percent", "scale_error_percent",
      "overlap_ratio", "landmarks_median", "pseudo_stereo_share", "frame_ms_median",
      "frame_ms_p99",  "cpu_percent",      "wearer_cpu_percent",  "bytes_per_s"};
};

/// Copies a number of a program's summary.yaml under a name of the summary.
void take(Json& metrics, const fs::path& summary, const std::string& key, const std::string& name) {
  if (!fs::exists(summary)) return;
  const ConfigFile file = ConfigFile::load(summary);
  if (file.root().has(key)) metrics[name] = file.root().number(key, 0.0);
}

Json metrics_of(const fs::path& run) {
  Json metrics = Json::object();
  for (const Metric& metric : read_metrics_json(run / "evaluation.json"))
    metrics[metric.name] = metric.value ? Json(*metric.value) : Json(nullptr);
  take(metrics, run / "summary.yaml", "cpu_percent", "cpu_percent");
  take(metrics, run / "wearable_summary.yaml", "cpu_percent", "wearer_cpu_percent");
  take(metrics, run / "wearable_summary.yaml", "bytes_per_s", "bytes_per_s");
  return metrics;
}

std::string number_text(const Json& metrics, const std::string& name) {
  if (!metrics.contains(name) || !metrics[name].is_number()) return "n/a";
  std::ostringstream text;
  text << std::setprecision(4) << metrics[name].get<double>();
  return text.str();
}

void print_table(const Json& summary, const std::vector<std::string>& names) {
  constexpr int kNameWidth = 22;
  constexpr int kColumnWidth = 15;
  std::cout << std::left << std::setw(kNameWidth) << "" << std::right;
  for (const auto& [mode, metrics] : summary.items())
    std::cout << std::setw(kColumnWidth) << mode;
  for (const std::string& name : names) {
    std::cout << '\n' << std::left << std::setw(kNameWidth) << name << std::right;
    for (const auto& [mode, metrics] : summary.items()) {
      std::cout << std::setw(kColumnWidth) << number_text(metrics, name);
    }
  }
  std::cout << '\n';
}

void run(const SummariseArguments& arguments) {
  Json summary = Json::object();
  std::vector<PlottedRun> plotted;
  for (const std::string& mode : arguments.modes) {
    summary[mode] = metrics_of(arguments.folder / mode);
    plotted.push_back({mode, arguments.folder / mode / "errors.csv"});
  }
  const fs::path path = arguments.folder / "summary.json";
  std::ofstream file(path);
  file << summary.dump(2) << '\n';
  file.close();
  if (!file) throw EvaluationError(path.string() + ": cannot be written");
  const fs::path picture = arguments.folder / "trajectories.png";
  if (!plot_trajectories(picture, fs::absolute(arguments.folder).filename().string(), plotted)) {
    std::cerr << "cosight summarise: gnuplot made no picture; is the package gnuplot-nox installed?\n";
  }
  print_table(summary, arguments.metrics);
}

}  // namespace

void add_summarise_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("summarise", "Gather several evaluated runs into one summary.json");
  const auto arguments = std::make_shared<SummariseArguments>();
  command->add_option("DIR", arguments->folder, "Folder with one folder a mode")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("MODE", arguments->modes, "Modes, in the order of the table")->required();
  command->add_option("--metrics", arguments->metrics, "Rows of the table")->delimiter(',');
  command->footer("Example: cosight summarise build/demo mono collaborative");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
