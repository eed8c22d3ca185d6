#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "shared/config/config.hpp"

namespace cosight {

/// One node of a configuration, and what the program asked of it. Private to this room.
struct ConfigTree {
  enum class Kind { kAbsent, kScalar, kList, kSection };

  std::string key;
  Kind kind = Kind::kAbsent;
  std::string scalar;
  std::vector<std::shared_ptr<ConfigTree>> children;  ///< of a list or of a section, in the file's order

  std::string origin;             ///< "config/robot.yaml:14" or "--rate"
  std::filesystem::path folder;   ///< what relative paths start from
  std::string dotted;             ///< "search.max_features"
  mutable bool known = false;     ///< a getter asked for it
  mutable std::string read_as{};  ///< yaml of the value that the getter gave

  ConfigTree* child(std::string_view name) const;
  /// The child of that name, made absent when there is none.
  ConfigTree& child_or_absent(std::string_view name);

  /// "origin: dotted: sentence"
  ConfigError error(const std::string& sentence) const;
};

/// Throws ConfigError with the line of the fault.
std::shared_ptr<ConfigTree> parse_config_tree(const std::string& yaml, const std::string& name,
                                              const std::filesystem::path& folder);

void apply_override(ConfigTree& root, const ConfigOverride& replacement);

}  // namespace cosight
