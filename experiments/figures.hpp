#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cosight::experiments {

/// What an experiment measured: group -> metric -> number, in the order in which they were set.
class Figures {
 public:
  void set(const std::string& group, const std::string& metric, double value);

  /// The other's groups after these.
  void append(const Figures& other);

  /// {"group": {"metric": number}}; a number that is not finite is null.
  std::string json() const;
  /// One column a group, one row a metric; "-" where a group has no such metric.
  std::string table() const;
  /// Writes json() to DIR/summary.json. Throws std::runtime_error.
  void write_summary(const std::filesystem::path& folder) const;

 private:
  struct Entry {
    std::string metric;
    double value = 0.0;
  };
  struct Group {
    std::string name;
    std::vector<Entry> entries;
  };

  std::vector<Group> groups_;
};

}  // namespace cosight::experiments
