#include <algorithm>
#include <fstream>
#include <numeric>
#include <sstream>

#include "shared/config/config.hpp"
#include "shared/config/config_tree.hpp"

namespace cosight {
namespace {

/// Levenshtein's distance, for "did you mean".
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t swap = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({swap, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

void refuse_unknown(const ConfigTree& section) {
  for (const auto& node : section.children) {
    if (node->known) {
      if (node->kind == ConfigTree::Kind::kSection || node->kind == ConfigTree::Kind::kList)
        refuse_unknown(*node);
      continue;
    }
    if (section.kind == ConfigTree::Kind::kList && node->kind != ConfigTree::Kind::kSection) continue;
    std::string nearest;
    std::string all;
    std::size_t best = std::max<std::size_t>(3, node->key.size() / 2);
    for (const auto& other : section.children) {
      if (!other->known) continue;
      all += (all.empty() ? "" : ", ") + other->key;
      const std::size_t distance = edit_distance(node->key, other->key);
      if (distance < best) {
        best = distance;
        nearest = other->key;
      }
    }
    if (!nearest.empty()) throw node->error("is no known key; did you mean " + nearest + "?");
    throw node->error("is no known key; " + (all.empty() ? "remove it" : "known here: " + all));
  }
}

void write_resolved(const ConfigTree& section, std::size_t indent, std::string& out);

/// The sections of a list: indented like a section of its own, with a dash before the first key.
void write_resolved_list(const ConfigTree& list, std::size_t indent, std::string& out) {
  for (const auto& section : list.children) {
    std::string inner;
    write_resolved(*section, indent + 2, inner);
    if (inner.empty()) inner = std::string(indent + 2, ' ') + "{}\n";
    inner[indent] = '-';
    out += inner;
  }
}

void write_resolved(const ConfigTree& section, std::size_t indent, std::string& out) {
  for (const auto& node : section.children) {
    if (!node->known) continue;
    std::string value;
    if (!node->read_as.empty()) {
      value = ' ' + node->read_as + '\n';
    } else {
      const bool is_list = node->kind == ConfigTree::Kind::kList;
      (is_list ? write_resolved_list : write_resolved)(*node, indent + 2, value);
      if (value.empty()) continue;
      value.insert(0, 1, '\n');
    }
    out.append(indent, ' ').append(node->key).append(1, ':').append(value);
  }
}

}  // namespace

ConfigOverride parse_override(const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigError("--set " + assignment + ": write it as KEY=VALUE, as in --set slam.max_landmarks=60");
  }
  return {assignment.substr(0, equals), assignment.substr(equals + 1), "--set", false};
}

ConfigFile::ConfigFile(std::shared_ptr<ConfigTree> tree) : tree_(std::move(tree)), root_(tree_) {}

ConfigFile ConfigFile::load(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides) {
  if (std::filesystem::is_directory(file))
    throw ConfigError(file.string() + ": is a folder, not a yaml file");
  std::ifstream in(file);
  std::stringstream text;
  if (!in || !(text << in.rdbuf() || in.peek() == std::ifstream::traits_type::eof())) {
    throw ConfigError(file.string() + ": can't be read; check the path");
  }
  auto tree = parse_config_tree(text.str(), file.string(), file.parent_path());
  for (const auto& replacement : overrides)
    apply_override(*tree, replacement);
  return ConfigFile(std::move(tree));
}

ConfigFile ConfigFile::parse(const std::string& yaml, const std::string& name,
                             const std::vector<ConfigOverride>& overrides) {
  auto tree = parse_config_tree(yaml, name, {});
  for (const auto& replacement : overrides)
    apply_override(*tree, replacement);
  return ConfigFile(std::move(tree));
}

void ConfigFile::refuse_unknown_keys() const {
  refuse_unknown(*tree_);
}

std::string ConfigFile::resolved() const {
  std::string out;
  write_resolved(*tree_, 0, out);
  return out;
}

}  // namespace cosight
