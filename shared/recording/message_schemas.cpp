#include "shared/recording/message_schemas.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include "shared/recording/builtin_idl.hpp"
#include "shared/recording/recording_error.hpp"

namespace cosight::recording {
namespace {

std::string contents_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw RecordingError("message definition " + path.string() + " can't be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// "geometry_msgs/Point" for "geometry_msgs/msg/Point", as definitions are headed.
std::string heading(std::string name) {
  if (const std::size_t middle = name.find("/msg/"); middle != std::string::npos) name.erase(middle, 4);
  return name;
}

}  // namespace

MessageSchemas MessageSchemas::built_in() {
  MessageSchemas schemas;
  for (const std::string_view idl : builtin_idl())
    for (MessageDefinition& definition : parse_idl(idl))
      schemas.add(std::move(definition));
  return schemas;
}

void MessageSchemas::add_folder(const std::filesystem::path& folder) {
  if (!std::filesystem::is_directory(folder))
    throw RecordingError("message definitions: " + folder.string() + " is not a folder");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::filesystem::path& path = entry.path();
    if (path.extension() == ".idl") {
      for (MessageDefinition& definition : parse_idl(contents_of(path)))
        add(std::move(definition));
    } else if (path.extension() == ".msg") {
      const auto parent = path.parent_path();
      const auto package = parent.filename() == "msg" ? parent.parent_path().filename() : parent.filename();
      add(parse_msg(package.string(), path.stem().string(), contents_of(path)));
    }
  }
}

void MessageSchemas::add(MessageDefinition definition) {
  std::string name = definition.name;
  definitions_.emplace(std::move(name), std::move(definition));
}

std::optional<std::string> MessageSchemas::ros2msg(const std::string& type) const {
  std::vector<std::string> needed{type};
  std::string text;
  for (std::size_t i = 0; i < needed.size(); ++i) {
    const auto found = definitions_.find(needed[i]);
    if (found == definitions_.end()) return std::nullopt;
    if (i > 0) text += std::string(80, '=') + "\nMSG: " + heading(needed[i]) + "\n";
    text += found->second.text;
    if (!text.empty() && text.back() != '\n') text += '\n';
    for (const std::string& field : found->second.fields_of)
      if (std::find(needed.begin(), needed.end(), field) == needed.end()) needed.push_back(field);
  }
  return text;
}

}  // namespace cosight::recording
