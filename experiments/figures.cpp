#include "experiments/figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace cosight::experiments {

void Figures::set(const std::string& group, const std::string& metric, double value) {
  auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.name == group; });
  if (found == groups_.end()) found = groups_.insert(groups_.end(), {group, {}});
  found->entries.push_back({metric, value});
}

void Figures::append(const Figures& other) {
  groups_.insert(groups_.end(), other.groups_.begin(), other.groups_.end());
}

std::string Figures::json() const {
  nlohmann::ordered_json summary = nlohmann::ordered_json::object();
  for (const Group& group : groups_) {
    for (const Entry& entry : group.entries) {
      auto& place = summary[group.name][entry.metric];
      if (entry.value == std::trunc(entry.value) && std::abs(entry.value) < 1e15) {
        place = static_cast<std::int64_t>(entry.value);
      } else {
        place = entry.value;
      }
    }
  }
  return summary.dump(2) + "\n";
}

std::string Figures::table() const {
  constexpr int kNameWidth = 30;
  std::vector<std::string> metrics;
  for (const Group& group : groups_) {
    for (const Entry& entry : group.entries) {
      if (std::find(metrics.begin(), metrics.end(), entry.metric) == metrics.end())
        metrics.push_back(entry.metric);
    }
  }
  const auto width = [](const Group& group) { return std::max(10, static_cast<int>(group.name.size()) + 2); };
  std::ostringstream text;
  text << std::setprecision(4) << std::setw(kNameWidth) << "";
  for (const Group& group : groups_)
    text << std::setw(width(group)) << group.name;
  for (const std::string& metric : metrics) {
    text << '\n' << std::left << std::setw(kNameWidth) << metric << std::right;
    for (const Group& group : groups_) {
      const auto entry = std::find_if(group.entries.begin(), group.entries.end(),
                                      [&](const Entry& e) { return e.metric == metric; });
      text << std::setw(width(group));
      if (entry == group.entries.end()) {
        text << "-";
      } else {
        text << entry->value;
      }
    }
  }
  text << '\n';
  return text.str();
}

void Figures::write_summary(const std::filesystem::path& folder) const {
  const std::filesystem::path path = folder / "summary.json";
  std::ofstream file(path);
  file << json();
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace cosight::experiments
