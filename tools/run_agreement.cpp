#include "tools/run_agreement.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>
#include <optional>

#include "shared/config/config.hpp"
#include "shared/evaluation/association.hpp"
#include "shared/evaluation/csv_table.hpp"
#include "shared/evaluation/error_statistics.hpp"
#include "shared/evaluation/evaluation_error.hpp"
#include "shared/evaluation/trajectory_errors.hpp"
#include "shared/evaluation/trajectory_reader.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw EvaluationError(path.string() + ": cannot be read; is this the folder of a finished run?");
  return {std::istreambuf_iterator<char>(file), {}};
}

double equal_files(const fs::path& a, const fs::path& b) {
  constexpr std::array kResults{"trajectory.tum", "map.ply", "map.pcd"};
  return static_cast<double>(std::count_if(kResults.begin(), kResults.end(), [&](const char* name) {
    return text_of(a / name) == text_of(b / name);
  }));
}

/// How long before or after the robot's frame the worn one was taken, as it is written; "" when there is
/// none.
using WornFrames = std::map<Stamp, std::string>;

WornFrames worn_frames(const fs::path& run) {
  const CsvTable table = CsvTable::read(run / "frames.csv");
  WornFrames worn;
  for (std::size_t row = 0; row < table.rows(); ++row)
    worn[table.stamp(row, "stamp_ns")] = table.text(row, "worn_delay_ms");
  return worn;
}

double other_worn_frames(const fs::path& a, const fs::path& b) {
  const WornFrames in_a = worn_frames(a);
  const WornFrames in_b = worn_frames(b);
  return static_cast<double>(std::count_if(in_a.begin(), in_a.end(), [&](const auto& frame) {
    const auto other = in_b.find(frame.first);
    return other != in_b.end() && other->second != frame.second;
  }));
}

bool is_equal(const PosePair& pair) {
  return pair.T_WC_estimate.p == pair.T_WC_truth.p &&
         pair.T_WC_estimate.q.coeffs() == pair.T_WC_truth.q.coeffs();
}

}  // namespace

std::vector<Metric> agreement(const fs::path& run, const fs::path& reference) {
  const auto pairs = associate(read_trajectory(run / "trajectory.tum"),
                               read_trajectory(reference / "trajectory.tum"), Stamp{0});
  if (pairs.empty()) throw EvaluationError(run.string() + " and " + reference.string() + " share no frame");
  const auto first_other = std::find_if_not(pairs.begin(), pairs.end(), is_equal);
  const ErrorStatistics distances = statistics_of(position_errors(pairs));
  const ErrorStatistics angles = statistics_of(rotation_errors(pairs));
  const auto equal = std::count_if(pairs.begin(), pairs.end(), is_equal);
  std::optional<double> first_other_s;
  if (first_other != pairs.end()) first_other_s = to_seconds(first_other->stamp - pairs.front().stamp);
  return {{"frames", static_cast<double>(pairs.size())},
          {"equal_poses", static_cast<double>(equal)},
          {"first_other_s", first_other_s},
          {"other_worn_frames", other_worn_frames(run, reference)},
          {"distance_rms_m", distances.rmse},
          {"distance_max_m", distances.max},
          {"angle_max_deg", angles.max * 180.0 / std::numbers::pi},
          {"equal_files", equal_files(run, reference)}};
}

std::vector<CounterRow> differing_counters(const std::vector<fs::path>& runs) {
  std::vector<CounterRow> rows;
  std::vector<ConfigFile> summaries;
  for (const fs::path& run : runs)
    summaries.push_back(ConfigFile::load(run / "summary.yaml"));
  for (const char* section : {"inbox", "wearer_by_laser"}) {
    if (summaries.empty() || !summaries.front().root().has(section)) continue;
    for (const std::string& key : summaries.front().root().section(section).keys()) {
      CounterRow row{std::string(section) + "." + key, {}};
      for (const ConfigFile& summary : summaries)
        row.counts.push_back(summary.root().section(section).number(key, 0.0));
      const bool differs = std::any_of(row.counts.begin(), row.counts.end(),
                                       [&](double count) { return count != row.counts.front(); });
      if (differs) rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace cosight
