#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "shared/config/config.hpp"

namespace cosight {

/// From what `ConfigFile::resolved` writes: "slam.map.max_landmarks" -> "60".
inline std::map<std::string, std::string> values_by_key(const std::string& resolved) {
  std::map<std::string, std::string> values;
  std::vector<std::string> sections;
  std::istringstream lines(resolved);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t depth = line.find_first_not_of(' ') / 2;
    const std::size_t colon = line.find(':');
    sections.resize(depth);
    sections.push_back(line.substr(2 * depth, colon - 2 * depth));
    if (colon + 1 == line.size()) continue;
    std::string key;
    for (const std::string& section : sections)
      key += (key.empty() ? "" : ".") + section;
    values[key] = line.substr(colon + 2);
  }
  return values;
}

/// Numbers may be rounded to a hundredth of themselves.
inline bool says_the_same(const std::string& a, const std::string& b) {
  char* end = nullptr;
  const double x = std::strtod(a.c_str(), &end);
  if (end == a.c_str() || *end != '\0') return a == b;
  return std::abs(x - std::strtod(b.c_str(), nullptr)) <= 0.01 * std::abs(x);
}

inline bool stands_in(const ConfigFile& file, const std::string& key) {
  ConfigNode node = file.root();
  std::size_t from = 0;
  for (auto dot = key.find('.'); dot != std::string::npos; dot = key.find('.', from)) {
    node = node.section(key.substr(from, dot - from));
    from = dot + 1;
  }
  return node.has(key.substr(from));
}

/// A file in config/ has every key that `read` reads, with its default. `required`: what has to be set
/// before anything can be read; `own`: keys whose value is the file's own.
template <class Read>
void expect_describes_defaults(const std::string& name, const Read& read, const std::string& required,
                               const std::vector<std::string>& own) {
  std::ifstream in(COSIGHT_SOURCE_DIR "/config/" + name);
  std::stringstream text;
  text << in.rdbuf();
  const ConfigFile file = ConfigFile::parse(text.str(), name, {parse_override(required)});
  const ConfigFile nothing = ConfigFile::parse("", "nothing", {parse_override(required)});
  read(file.root());
  read(nothing.root());
  EXPECT_NO_THROW(file.refuse_unknown_keys());
  const auto given = values_by_key(file.resolved());
  for (const auto& [key, otherwise] : values_by_key(nothing.resolved())) {
    EXPECT_TRUE(stands_in(file, key))
        << "config/" << name << " says nothing about " << key << ": " << otherwise;
    const bool may_differ = std::find(own.begin(), own.end(), key) != own.end();
    EXPECT_TRUE(may_differ || says_the_same(otherwise, given.at(key)))
        << "config/" << name << " has " << key << ": " << given.at(key) << ", the default is " << otherwise;
  }
}

}  // namespace cosight
