#include "shared/config/config_tree.hpp"

#include <yaml-cpp/yaml.h>

#include <utility>

namespace cosight {
namespace {

/// Where a piece of yaml came from, and a guard against yaml that unfolds without end through its aliases.
struct Reading {
  std::string name;
  std::filesystem::path folder;
  bool has_lines = true;
  int nodes = 0;

  std::string at(const YAML::Mark& mark) const {
    return has_lines && !mark.is_null() ? name + ":" + std::to_string(mark.line + 1) : name;
  }
};

constexpr int kMaxNodes = 100'000;
constexpr int kMaxDepth = 32;

std::string join(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

std::shared_ptr<ConfigTree> convert(const YAML::Node& node, Reading& reading, const std::string& key,
                                    const std::string& dotted, int depth);

void convert_section(const YAML::Node& node, Reading& reading, ConfigTree& tree, int depth) {
  tree.kind = ConfigTree::Kind::kSection;
  for (const auto& entry : node) {
    if (!entry.first.IsScalar()) throw tree.error("a key has to be a word");
    const std::string key = entry.first.Scalar();
    auto child = convert(entry.second, reading, key, join(tree.dotted, key), depth + 1);
    child->origin = reading.at(entry.first.Mark());
    if (const ConfigTree* twin = tree.child(key)) {
      throw child->error("is given twice, first at " + twin->origin + "; keep one");
    }
    tree.children.push_back(std::move(child));
  }
}

std::shared_ptr<ConfigTree> convert(const YAML::Node& node, Reading& reading, const std::string& key,
                                    const std::string& dotted, int depth) {
  auto tree = std::make_shared<ConfigTree>();
  tree->key = key;
  tree->dotted = dotted;
  tree->folder = reading.folder;
  tree->origin = reading.at(node.Mark());
  if (depth > kMaxDepth || ++reading.nodes > kMaxNodes) throw tree->error("is nested too deep or too large");
  if (node.IsMap()) {
    convert_section(node, reading, *tree, depth);
  } else if (node.IsSequence()) {
    tree->kind = ConfigTree::Kind::kList;
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string index = "[" + std::to_string(i) + "]";
      tree->children.push_back(convert(node[i], reading, index, dotted + index, depth + 1));
    }
  } else if (node.IsScalar()) {
    tree->kind = ConfigTree::Kind::kScalar;
    tree->scalar = node.Scalar();
  }
  return tree;
}

std::shared_ptr<ConfigTree> parse(const std::string& yaml, Reading reading, const std::string& key,
                                  const std::string& dotted) {
  try {
    return convert(YAML::Load(yaml), reading, key, dotted, 0);
  } catch (const YAML::Exception& e) {
    throw ConfigError(reading.at(e.mark) + ": " + (dotted.empty() ? "" : dotted + ": ") +
                      "not yaml: " + e.msg);
  }
}

/// The section that holds the last part of a dotted key; sections on the way are made when they are absent.
ConfigTree& parent_section(ConfigTree& root, std::string_view dotted, const std::string& origin) {
  ConfigTree* section = &root;
  for (auto dot = dotted.find('.'); dot != std::string_view::npos; dot = dotted.find('.')) {
    section = &section->child_or_absent(dotted.substr(0, dot));
    if (section->kind == ConfigTree::Kind::kScalar || section->kind == ConfigTree::Kind::kList) {
      throw ConfigError(origin + ": " + section->dotted + " is a value, not a section");
    }
    if (section->kind == ConfigTree::Kind::kAbsent) section->origin = origin;
    section->kind = ConfigTree::Kind::kSection;
    dotted.remove_prefix(dot + 1);
  }
  return *section;
}

}  // namespace

ConfigTree* ConfigTree::child(std::string_view name) const {
  for (const auto& node : children) {
    if (node->key == name) return node.get();
  }
  return nullptr;
}

ConfigTree& ConfigTree::child_or_absent(std::string_view name) {
  if (ConfigTree* existing = child(name)) return *existing;
  auto node = std::make_shared<ConfigTree>();
  node->key = name;
  node->dotted = join(dotted, node->key);
  node->folder = folder;
  node->origin = origin;
  return *children.emplace_back(std::move(node));
}

ConfigError ConfigTree::error(const std::string& sentence) const {
  return ConfigError(origin + ": " + (dotted.empty() ? "" : dotted + ": ") + sentence);
}

std::shared_ptr<ConfigTree> parse_config_tree(const std::string& yaml, const std::string& name,
                                              const std::filesystem::path& folder) {
  auto tree = parse(yaml, {.name = name, .folder = folder}, "", "");
  if (tree->kind == ConfigTree::Kind::kScalar || tree->kind == ConfigTree::Kind::kList) {
    throw tree->error("is a single value or a list; write `key: value` lines");
  }
  tree->kind = ConfigTree::Kind::kSection;
  return tree;
}

void apply_override(ConfigTree& root, const ConfigOverride& replacement) {
  ConfigTree& section = parent_section(root, replacement.key, replacement.origin);
  const std::string key = replacement.key.substr(replacement.key.rfind('.') + 1);
  if (key.empty()) throw ConfigError(replacement.origin + ": " + replacement.key + " is no key");
  auto value = std::make_shared<ConfigTree>();
  if (replacement.plain_text) {
    value->key = key;
    value->kind = ConfigTree::Kind::kScalar;
    value->scalar = replacement.value;
    value->dotted = replacement.key;
  } else {
    value = parse(replacement.value, {.name = replacement.origin, .folder = {}, .has_lines = false}, key,
                  replacement.key);
  }
  value->origin = replacement.origin;
  for (auto& node : section.children) {
    if (node->key == key) {
      node = std::move(value);
      return;
    }
  }
  section.children.push_back(std::move(value));
}

}  // namespace cosight
