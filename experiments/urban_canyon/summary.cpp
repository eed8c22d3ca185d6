#include "experiments/urban_canyon/summary.hpp"

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace cosight::experiments {

void Summary::write(const std::filesystem::path& file) const {
  nlohmann::ordered_json json;
  for (const auto& [group, methods] : groups_) {
    for (const auto& [method, metrics] : methods) {
      for (const auto& [metric, value] : metrics) {
        constexpr double kDigits = 1e5;
        auto& place = json[group][method][metric];
        if (std::isfinite(value)) place = std::round(kDigits * value) / kDigits;
      }
    }
  }
  std::ofstream stream(file);
  stream << json.dump(2) << '\n';
  if (!stream) throw std::runtime_error(file.string() + " could not be written; is the disk full?");
}

}  // namespace cosight::experiments
