#include "shared/recording/type_names.hpp"

namespace cosight::recording {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";
constexpr std::string_view kDdsNamespace = "dds_::";

std::string replaced(std::string_view text, std::string_view what, std::string_view with) {
  std::string result;
  for (std::size_t at = text.find(what); at != std::string_view::npos; at = text.find(what)) {
    result.append(text.substr(0, at)).append(with);
    text.remove_prefix(at + what.size());
  }
  return result.append(text);
}

}  // namespace

std::string ros_topic(std::string_view dds_topic) {
  if (!dds_topic.starts_with(kTopicPrefix)) return std::string(dds_topic);
  return std::string(dds_topic.substr(kTopicPrefix.size() - 1));
}

std::string dds_topic(std::string_view ros_topic) {
  if (!ros_topic.starts_with('/')) return std::string(ros_topic);
  return std::string(kTopicPrefix).append(ros_topic.substr(1));
}

std::string ros_type(std::string_view dds_type) {
  const std::size_t last = dds_type.rfind(kDdsNamespace);
  if (last == std::string_view::npos || !dds_type.ends_with('_')) return replaced(dds_type, "::", "/");
  std::string name(dds_type.substr(0, last));
  name.append(dds_type.substr(last + kDdsNamespace.size()));
  name.pop_back();
  return replaced(name, "::", "/");
}

std::string dds_type(std::string_view ros_type) {
  const std::size_t slash = ros_type.rfind('/');
  const bool is_ros = slash != std::string_view::npos && ros_type.substr(0, slash).ends_with("/msg");
  if (!is_ros) return replaced(ros_type, "/", "::");
  const std::string package = replaced(ros_type.substr(0, slash), "/", "::");
  return package + "::" + std::string(kDdsNamespace) + std::string(ros_type.substr(slash + 1)) + "_";
}

bool matches(std::string_view text, std::string_view pattern) {
  std::size_t t = 0, p = 0, star = std::string_view::npos, star_text = 0;
  while (t < text.size()) {
    if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t]) && pattern[p] != '*') {
      ++t, ++p;
    } else if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      star_text = t;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      t = ++star_text;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

}  // namespace cosight::recording
