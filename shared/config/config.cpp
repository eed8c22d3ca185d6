#include "shared/config/config.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>

#include "shared/config/config_tree.hpp"

namespace cosight {
namespace {

using Kind = ConfigTree::Kind;

std::string show(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

template <class Number>
std::optional<Number> parse(const std::string& text) {
  Number value{};
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, fault] = std::from_chars(first, text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::string quote(const std::string& text) {
  return "'" + text + "'";
}

/// What a wrong value is answered with, after the sentence: how to get on without thinking.
std::string or_leave_out(const std::string& otherwise) {
  return "; leave it out for " + otherwise;
}

template <class Number>
void check_range(const ConfigTree& node, Number value, Number min, Number max, const std::string& hint) {
  if (value >= min && value <= max) return;
  const auto bound = [](Number b) { return show(static_cast<double>(b)); };
  const bool below_only = max >= std::numeric_limits<Number>::max();
  const bool above_only = min <= std::numeric_limits<Number>::lowest();
  std::string sentence = bound(value) + " is ";
  if (below_only) {
    sentence += "below " + bound(min);
  } else if (above_only) {
    sentence += "above " + bound(max);
  } else {
    sentence += "not in [" + bound(min) + ", " + bound(max) + "]";
  }
  throw node.error(sentence + hint);
}

double finite_number(const ConfigTree& node, const std::string& hint) {
  if (node.kind != Kind::kScalar) throw node.error("has to be a number" + hint);
  const auto value = parse<double>(node.scalar);
  if (!value) throw node.error(quote(node.scalar) + " is not a number" + hint);
  if (!std::isfinite(*value)) throw node.error(quote(node.scalar) + " is not a finite number" + hint);
  return *value;
}

void append_numbers(const ConfigTree& node, double min, double max, std::vector<double>& values) {
  for (const auto& element : node.children) {
    if (element->kind == Kind::kList) {
      append_numbers(*element, min, max, values);
    } else {
      values.push_back(finite_number(*element, ""));
      check_range(*element, values.back(), min, max, "");
    }
  }
}

std::string show(const std::vector<double>& values) {
  std::string text = "[";
  for (const double value : values)
    text += (text.size() > 1 ? ", " : "") + show(value);
  return text + "]";
}

std::string environment(const std::string& name, const ConfigTree& node) {
  if (const char* value = std::getenv(name.c_str())) return value;  // NOLINT(concurrency-mt-unsafe)
  if (name == "COSIGHT_DATA") return std::filesystem::absolute("../shared/data").lexically_normal().string();
  throw node.error("$" + name + " is not set; export it or write the path out");
}

/// `~/x`, `$NAME/x`, `${NAME}/x`, at the start or inside.
std::string expand(const std::string& text, const ConfigTree& node) {
  std::string out = text;
  if (out == "~" || out.starts_with("~/")) out.replace(0, 1, environment("HOME", node));
  for (auto at = out.find('$'); at != std::string::npos; at = out.find('$', at)) {
    const bool braced = out.compare(at + 1, 1, "{") == 0;
    const auto is_name = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    const auto first = out.begin() + static_cast<std::ptrdiff_t>(at) + (braced ? 2 : 1);
    const auto last = std::find_if_not(first, out.end(), is_name);
    if (first == last || (braced && (last == out.end() || *last != '}'))) {
      throw node.error(quote(text) + " has a $ without a name");
    }
    const std::string value = environment({first, last}, node);
    const auto length = (last - out.begin()) - static_cast<std::ptrdiff_t>(at) + (braced ? 1 : 0);
    out.replace(at, static_cast<std::size_t>(length), value);
    at += value.size();
  }
  return out;
}

/// As yaml: in single quotes, a quote doubled.
std::string yaml_text(const std::string& text) {
  std::string out = "'";
  for (const char c : text)
    out += c == '\'' ? std::string("''") : std::string(1, c);
  return out + "'";
}

}  // namespace

const ConfigTree* ConfigNode::find(std::string_view key) const {
  ConfigTree& node = tree_->child_or_absent(key);
  node.known = true;
  return &node;
}

double ConfigNode::number(std::string_view key, double otherwise, double min, double max) const {
  const ConfigTree* node = find(key);
  double value = otherwise;
  if (node->kind != Kind::kAbsent) {
    const std::string hint = or_leave_out(show(otherwise));
    value = finite_number(*node, hint);
    check_range(*node, value, min, max, hint);
  }
  node->read_as = show(value);
  return value;
}

int ConfigNode::integer(std::string_view key, int otherwise, int min, int max) const {
  const ConfigTree* node = find(key);
  int value = otherwise;
  if (node->kind != Kind::kAbsent) {
    const std::string hint = or_leave_out(std::to_string(otherwise));
    const auto given = node->kind == Kind::kScalar ? parse<int>(node->scalar) : std::nullopt;
    if (!given) throw node->error(quote(node->scalar) + " is not a whole number" + hint);
    value = *given;
    check_range(*node, value, min, max, hint);
  }
  node->read_as = std::to_string(value);
  return value;
}

bool ConfigNode::boolean(std::string_view key, bool otherwise) const {
  const ConfigTree* node = find(key);
  bool value = otherwise;
  if (node->kind != Kind::kAbsent) {
    value = node->scalar == "true";
    if (node->kind != Kind::kScalar || (!value && node->scalar != "false")) {
      throw node->error(quote(node->scalar) + " is neither true nor false");
    }
  }
  node->read_as = value ? "true" : "false";
  return value;
}

std::string ConfigNode::text(std::string_view key, std::string_view otherwise) const {
  const ConfigTree* node = find(key);
  if (node->kind == Kind::kList || node->kind == Kind::kSection) throw node->error("has to be a text");
  std::string value = node->kind == Kind::kScalar ? node->scalar : std::string(otherwise);
  node->read_as = yaml_text(value);
  return value;
}

std::ptrdiff_t ConfigNode::choice_index(std::string_view key, std::size_t otherwise,
                                        std::span<const std::string_view> names) const {
  const ConfigTree* node = find(key);
  auto chosen = names.begin() + static_cast<std::ptrdiff_t>(otherwise);
  if (node->kind != Kind::kAbsent) {
    chosen = node->kind == Kind::kScalar ? std::find(names.begin(), names.end(), node->scalar) : names.end();
    if (chosen == names.end()) {
      std::string all;
      for (const auto name : names)
        all += (all.empty() ? "" : ", ") + std::string(name);
      throw node->error(quote(node->scalar) + " is none of " + all);
    }
  }
  node->read_as = *chosen;
  return chosen - names.begin();
}

std::filesystem::path ConfigNode::path(std::string_view key, const std::filesystem::path& otherwise) const {
  const ConfigTree* node = find(key);
  if (node->kind == Kind::kList || node->kind == Kind::kSection) throw node->error("has to be a path");
  std::filesystem::path value = otherwise;
  if (node->kind == Kind::kScalar) {
    value = expand(node->scalar, *node);
    if (!value.empty() && value.is_relative()) value = (node->folder / value).lexically_normal();
  }
  node->read_as = yaml_text(value.string());
  return value;
}

std::vector<double> ConfigNode::numbers(std::string_view key, const std::vector<double>& otherwise,
                                        double min, double max) const {
  const ConfigTree* node = find(key);
  std::vector<double> values = otherwise;
  if (node->kind != Kind::kAbsent) {
    if (node->kind != Kind::kList) throw node->error("has to be a list of numbers, as [1, 2]");
    values.clear();
    append_numbers(*node, min, max, values);
  }
  node->read_as = show(values);
  return values;
}

Eigen::Vector3d ConfigNode::vector3(std::string_view key, const Eigen::Vector3d& otherwise, double min,
                                    double max) const {
  const auto values = numbers(key, {otherwise.x(), otherwise.y(), otherwise.z()}, min, max);
  if (values.size() != 3) throw error(key, "has to be three numbers, not " + std::to_string(values.size()));
  return {values[0], values[1], values[2]};
}

std::vector<std::string> ConfigNode::texts(std::string_view key,
                                           const std::vector<std::string>& otherwise) const {
  const ConfigTree* node = find(key);
  std::vector<std::string> values = otherwise;
  if (node->kind != Kind::kAbsent) {
    if (node->kind != Kind::kList) throw node->error("has to be a list of texts, as [a, b]");
    values.clear();
    for (const auto& element : node->children) {
      if (element->kind != Kind::kScalar) throw element->error("has to be a text");
      values.push_back(element->scalar);
    }
  }
  std::string shown;
  for (const auto& value : values)
    shown += (shown.empty() ? "" : ", ") + yaml_text(value);
  node->read_as = "[" + shown + "]";
  return values;
}

Eigen::MatrixXd ConfigNode::matrix(std::string_view key, const Eigen::MatrixXd& otherwise) const {
  std::vector<double> flat;
  for (Eigen::Index row = 0; row < otherwise.rows(); ++row) {
    for (Eigen::Index column = 0; column < otherwise.cols(); ++column)
      flat.push_back(otherwise(row, column));
  }
  const std::size_t size = flat.size();
  flat = numbers(key, flat);
  if (flat.size() != size) {
    throw error(key, "has to be " + std::to_string(otherwise.rows()) + " rows of " +
                         std::to_string(otherwise.cols()) + " numbers, not " + std::to_string(flat.size()) +
                         " in all");
  }
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      flat.data(), otherwise.rows(), otherwise.cols());
}

ConfigNode ConfigNode::section(std::string_view key) const {
  const ConfigTree* node = find(key);
  if (node->kind == Kind::kScalar || node->kind == Kind::kList) {
    throw node->error("has to be a section with keys of its own");
  }
  const auto& children = tree_->children;
  return ConfigNode(
      *std::find_if(children.begin(), children.end(), [&](auto& c) { return c.get() == node; }));
}

std::vector<ConfigNode> ConfigNode::sections(std::string_view key) const {
  const ConfigTree* node = find(key);
  std::vector<ConfigNode> list;
  if (node->kind == Kind::kAbsent) return list;
  if (node->kind != Kind::kList) throw node->error("has to be a list of sections");
  for (const auto& element : node->children) {
    if (element->kind != Kind::kSection) throw element->error("has to be a section with keys of its own");
    element->known = true;
    list.emplace_back(element);
  }
  return list;
}

bool ConfigNode::has(std::string_view key) const {
  const ConfigTree* node = tree_->child(key);
  return node != nullptr && node->kind != Kind::kAbsent;
}

std::vector<std::string> ConfigNode::keys() const {
  std::vector<std::string> names;
  for (const auto& node : tree_->children) {
    if (node->kind != Kind::kAbsent) names.push_back(node->key);
  }
  return names;
}

ConfigError ConfigNode::error(std::string_view key, const std::string& sentence) const {
  return find(key)->error(sentence);
}

}  // namespace cosight
