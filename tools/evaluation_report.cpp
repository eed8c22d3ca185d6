#include "tools/evaluation_report.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {
namespace {

void require_written(std::ofstream& file, const std::filesystem::path& path) {
  file.close();
  if (!file)
    throw EvaluationError(path.string() + ": cannot be written; is the folder there and the disk not full?");
}

}  // namespace

std::string metrics_table(const std::vector<Metric>& metrics) {
  std::size_t width = 0;
  for (const Metric& metric : metrics)
    width = std::max(width, metric.name.size());
  std::ostringstream table;
  for (const Metric& metric : metrics) {
    table << "  " << std::left << std::setw(static_cast<int>(width)) << metric.name << "  " << std::right
          << std::setw(12);
    if (metric.value) {
      table << std::setprecision(5) << *metric.value << '\n';
    } else {
      table << "n/a" << '\n';
    }
  }
  return table.str();
}

void write_metrics_json(const std::filesystem::path& path, const std::vector<Metric>& metrics) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Metric& metric : metrics) {
    json[metric.name] =
        metric.value ? nlohmann::ordered_json(*metric.value) : nlohmann::ordered_json(nullptr);
  }
  std::ofstream file(path);
  file << json.dump(2) << '\n';
  require_written(file, path);
}

std::vector<Metric> read_metrics_json(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw EvaluationError(path.string() + ": cannot be opened; did this run fail?");
  std::vector<Metric> metrics;
  try {
    const auto json = nlohmann::ordered_json::parse(file);
    for (const auto& [name, value] : json.items())
      metrics.push_back({name, value.is_number() ? std::optional(value.get<double>()) : std::nullopt});
  } catch (const nlohmann::json::exception& error) {
    throw EvaluationError(path.string() + ": is not JSON: " + error.what());
  }
  return metrics;
}

void write_errors_csv(const std::filesystem::path& path, const Evaluation& evaluation) {
  std::ofstream file(path);
  file << "stamp_ns,time_s,truth_x_m,truth_y_m,truth_z_m,estimate_x_m,estimate_y_m,estimate_z_m,"
          "position_error_m,rotation_error_deg\n";
  for (std::size_t i = 0; i < evaluation.pairs.size(); ++i) {
    const PosePair& pair = evaluation.pairs[i];
    file << pair.stamp << ',' << to_seconds(pair.stamp - evaluation.pairs.front().stamp);
    for (const Pose* T_WC : {&pair.T_WC_truth, &pair.T_WC_estimate}) {
      for (const double coordinate : T_WC->p)
        file << ',' << coordinate;
    }
    file << ',' << evaluation.position_errors[i] << ','
         << evaluation.rotation_errors[i] * 180.0 / std::numbers::pi << '\n';
  }
  require_written(file, path);
}

}  // namespace cosight
