#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "shared/recording/idl_tokens.hpp"
#include "shared/recording/message_definition.hpp"
#include "shared/recording/recording_error.hpp"
#include "shared/recording/type_names.hpp"

namespace cosight::recording {
namespace {

constexpr std::string_view kConstants = "_Constants";

/// A type as a .msg field writes it: "float64", "geometry_msgs/Point", and what follows it: "[9]", "[]".
struct FieldType {
  std::string name;
  std::string array;
  std::string message;  ///< full name when it is one
};

/// ROS 2's name of a primitive type, which may be up to three words long.
std::optional<std::string> primitive(const std::string& idl) {
  static const std::map<std::string, std::string> names = {{"boolean", "bool"},
                                                           {"octet", "uint8"},
                                                           {"char", "uint8"},
                                                           {"int8", "int8"},
                                                           {"uint8", "uint8"},
                                                           {"int16", "int16"},
                                                           {"uint16", "uint16"},
                                                           {"int32", "int32"},
                                                           {"uint32", "uint32"},
                                                           {"int64", "int64"},
                                                           {"uint64", "uint64"},
                                                           {"float", "float32"},
                                                           {"double", "float64"},
                                                           {"short", "int16"},
                                                           {"long", "int32"},
                                                           {"long long", "int64"},
                                                           {"unsigned short", "uint16"},
                                                           {"unsigned long", "uint32"},
                                                           {"unsigned long long", "uint64"},
                                                           {"string", "string"},
                                                           {"wstring", "wstring"}};
  const auto found = names.find(idl);
  return found == names.end() ? std::nullopt : std::optional(found->second);
}

/// "geometry_msgs/Point" for "geometry_msgs/msg/Point": how a field says it.
std::string field_name(const std::string& message) {
  const std::size_t middle = message.find("/msg/");
  return middle == std::string::npos ? message : message.substr(0, middle) + message.substr(middle + 4);
}

class IdlParser {
 public:
  explicit IdlParser(std::string_view text) : tokens_(idl_tokens(text)) {}

  std::vector<MessageDefinition> run() {
    try {
      while (!at_end())
        parse_definition();
    } catch (const RecordingError&) {
      // What came before the mistake is good.
    }
    return std::move(definitions_);
  }

 private:
  bool at_end() const { return next_ >= tokens_.size(); }
  std::string peek() const { return at_end() ? std::string() : tokens_[next_]; }
  std::string take() {
    if (at_end()) throw RecordingError("an .idl file ends in the middle");
    return tokens_[next_++];
  }
  bool take_if(std::string_view token) {
    if (peek() != token) return false;
    ++next_;
    return true;
  }
  void expect(std::string_view token) {
    if (!take_if(token))
      throw RecordingError("an .idl file has '" + peek() + "' in place of '" + std::string(token) + "'");
  }
  /// Past the next `end` outside of brackets.
  void skip_past(std::string_view end) {
    int depth = 0;
    for (std::string token = take(); depth > 0 || token != end; token = take()) {
      if (token == "{" || token == "(") ++depth;
      if (token == "}" || token == ")") --depth;
    }
  }
  void skip_annotations() {
    while (peek().starts_with('@')) {
      take();
      if (take_if("(")) skip_past(")");
    }
  }

  void parse_definition() {
    skip_annotations();
    const std::string word = take();
    if (word == "module") return parse_module();
    if (word == "struct") return parse_struct();
    if (word == "typedef") return parse_typedef();
    if (word == "const") return parse_constant();
    if (word == "enum") return parse_enum();
    if (word != ";") skip_past(";");
  }

  void parse_module() {
    scope_.push_back(take());
    expect("{");
    while (!take_if("}"))
      parse_definition();
    take_if(";");
    scope_.pop_back();
  }

  void parse_struct() {
    MessageDefinition definition;
    definition.name = ros_type(scoped(take()));
    known_.insert(definition.name);
    if (take_if(";")) return;  // only announced
    if (const auto constants = constants_.find(definition.name); constants != constants_.end())
      definition.text = constants->second;
    bool is_sayable = !take_if(":");
    if (!is_sayable) take();
    expect("{");
    while (!take_if("}"))
      is_sayable = parse_field(definition) && is_sayable;
    take_if(";");
    if (is_sayable) definitions_.push_back(std::move(definition));
  }

  /// False when ROS 2 has no such field.
  bool parse_field(MessageDefinition& definition) {
    skip_annotations();
    const auto type = parse_type();
    if (!type) {
      skip_past(";");
      return false;
    }
    do {
      const std::string name = take();
      const std::string array = type->array + parse_dimensions();
      if (std::count(array.begin(), array.end(), '[') > 1) {
        skip_past(";");
        return false;
      }
      definition.text += type->name + array + " " + name + "\n";
      if (!type->message.empty()) definition.fields_of.push_back(type->message);
    } while (take_if(","));
    expect(";");
    return true;
  }

  void parse_typedef() {
    const auto type = parse_type();
    const std::string name = take();
    const std::string dimensions = parse_dimensions();
    expect(";");
    if (!type) return;
    FieldType alias = *type;
    alias.array += dimensions;
    aliases_[scoped(name)] = alias;
  }

  /// ROS 2 keeps a message's constants in a module of their own before it.
  void parse_constant() {
    const auto type = parse_type();
    const std::string name = take();
    expect("=");
    std::string value;
    while (!take_if(";"))
      value += take();
    if (!type || scope_.empty() || !scope_.back().ends_with(kConstants)) return;
    std::string message = joined_scope();
    message.resize(message.size() - kConstants.size());
    constants_[ros_type(message)] += type->name + " " + name + "=" + value + "\n";
  }

  /// On the wire an enumerator is a number.
  void parse_enum() {
    aliases_[scoped(take())] = {"uint32", "", ""};
    skip_past(";");
  }

  std::optional<FieldType> parse_type() {
    skip_annotations();
    if (take_if("sequence")) return parse_sequence();
    std::string word = take();
    if (word == "map" || word == "any" || word == "fixed" || word == "wchar") return std::nullopt;
    if (word == "string" || word == "wstring") return FieldType{word + parse_bound(), "", ""};
    if (word == "unsigned") word += " " + take();
    if ((word == "long" || word == "unsigned long") && peek() == "long") word += " " + take();
    if (const auto name = primitive(word)) {
      if (word == "long" && peek() == "double") return std::nullopt;
      return FieldType{*name, "", ""};
    }
    return resolve(word);
  }

  std::optional<FieldType> parse_sequence() {
    expect("<");
    auto type = parse_type();
    std::string bound;
    if (take_if(",")) bound = "<=" + take();
    expect(">");
    if (!type || !type->array.empty()) return std::nullopt;
    type->array = "[" + bound + "]";
    return type;
  }

  std::string parse_bound() {
    if (!take_if("<")) return "";
    std::string bound = "<=" + take();
    expect(">");
    return bound;
  }

  std::string parse_dimensions() {
    std::string dimensions;
    while (take_if("[")) {
      dimensions += "[" + take() + "]";
      expect("]");
    }
    return dimensions;
  }

  std::string joined_scope() const {
    std::string name;
    for (const std::string& module : scope_)
      name += (name.empty() ? "" : "::") + module;
    return name;
  }
  std::string scoped(const std::string& name) const {
    return scope_.empty() ? name : joined_scope() + "::" + name;
  }

  /// From the innermost module outwards; a name that nobody in this file has said is another file's.
  FieldType resolve(std::string name) const {
    if (name.starts_with("::")) name.erase(0, 2);
    for (std::size_t depth = scope_.size() + 1; depth-- > 0;) {
      std::string candidate;
      for (std::size_t i = 0; i < depth; ++i)
        candidate += scope_[i] + "::";
      candidate += name;
      if (const auto alias = aliases_.find(candidate); alias != aliases_.end()) return alias->second;
      if (known_.contains(ros_type(candidate)))
        return {field_name(ros_type(candidate)), "", ros_type(candidate)};
    }
    if (name.find("::") == std::string::npos) name = scoped(name);
    return {field_name(ros_type(name)), "", ros_type(name)};
  }

  std::vector<std::string> tokens_;
  std::size_t next_ = 0;
  std::vector<std::string> scope_;
  std::map<std::string, FieldType> aliases_;
  std::map<std::string, std::string> constants_;  ///< by message
  std::set<std::string> known_;
  std::vector<MessageDefinition> definitions_;
};

}  // namespace

std::vector<MessageDefinition> parse_idl(std::string_view text) {
  return IdlParser(text).run();
}

}  // namespace cosight::recording
