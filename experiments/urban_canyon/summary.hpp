#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cosight::experiments {

/// What was measured: group -> method -> metric -> number.
class Summary {
 public:
  void set(const std::string& group, const std::string& method,
           const std::vector<std::pair<std::string, double>>& metrics) {
    groups_[group][method] = {metrics.begin(), metrics.end()};
  }

  /// As JSON; a number that is not finite is null. Throws std::runtime_error.
  void write(const std::filesystem::path& file) const;

 private:
  std::map<std::string, std::map<std::string, std::map<std::string, double>>> groups_;
};

}  // namespace cosight::experiments
