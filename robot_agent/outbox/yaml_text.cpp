#include "robot_agent/outbox/yaml_text.hpp"

#include <array>
#include <cmath>
#include <cstdio>

namespace cosight::outbox {

YamlText& YamlText::value(std::string_view key, double number) {
  if (!std::isfinite(number)) return line(key, "null");
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.6g", number);
  return line(key, digits.data());
}

YamlText& YamlText::value(std::string_view key, std::uint64_t number) {
  return line(key, std::to_string(number));
}

YamlText& YamlText::value(std::string_view key, bool truth) {
  return line(key, truth ? "true" : "false");
}

YamlText& YamlText::value(std::string_view key, std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\x%02x", static_cast<unsigned>(c));
      quoted += escape.data();
    } else {
      quoted += c;
    }
  }
  return line(key, quoted + '"');
}

YamlText& YamlText::counts(std::span<const std::pair<std::string_view, std::uint64_t>> counts) {
  for (const auto& [name, count] : counts)
    value(name, count);
  return *this;
}

YamlText& YamlText::section(std::string_view name) {
  in_section_ = false;
  line(name, "");
  in_section_ = true;
  return *this;
}

YamlText& YamlText::top() {
  in_section_ = false;
  return *this;
}

YamlText& YamlText::line(std::string_view key, std::string_view rest) {
  if (in_section_) text_ += "  ";
  text_ += key;
  text_ += ':';
  if (!rest.empty()) text_ += ' ';
  text_ += rest;
  text_ += '\n';
  return *this;
}

}  // namespace cosight::outbox
