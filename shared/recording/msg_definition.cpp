#include <algorithm>
#include <array>
#include <sstream>

#include "shared/recording/message_definition.hpp"

namespace cosight::recording {
namespace {

bool is_builtin(std::string_view type) {
  constexpr std::array kBuiltins = {"bool",   "byte",   "char",    "float32", "float64", "int8",
                                    "uint8",  "int16",  "uint16",  "int32",   "uint32",  "int64",
                                    "uint64", "string", "wstring", "time",    "duration"};
  return std::find(kBuiltins.begin(), kBuiltins.end(), type) != kBuiltins.end();
}

/// "geometry_msgs/msg/Point" for what a field of `package` calls "geometry_msgs/Point", "Point" or "Header".
std::string full_name(const std::string& package, const std::string& type) {
  const std::size_t slash = type.find('/');
  if (slash == std::string::npos) return (type == "Header" ? "std_msgs" : package) + "/msg/" + type;
  return type.substr(0, slash) + "/msg/" + type.substr(type.rfind('/') + 1);
}

}  // namespace

MessageDefinition parse_msg(const std::string& package, const std::string& name, const std::string& text) {
  MessageDefinition definition{package + "/msg/" + name, text, {}};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type;
    if (!(words >> type)) continue;
    type = type.substr(0, type.find_first_of("[<"));
    if (!is_builtin(type)) definition.fields_of.push_back(full_name(package, type));
  }
  return definition;
}

}  // namespace cosight::recording
