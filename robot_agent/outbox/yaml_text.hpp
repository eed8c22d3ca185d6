#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace cosight::outbox {

/// Nested keys and values as yaml, in the order they are given:
///
///   YamlText text;
///   text.value("frames", std::uint64_t{100});
///   text.section("timing").value("frame_ms_median", 8.1);
class YamlText {
 public:
  YamlText& value(std::string_view key, double number);  ///< a number that is not finite becomes `null`
  YamlText& value(std::string_view key, std::uint64_t number);
  YamlText& value(std::string_view key, bool truth);
  YamlText& value(std::string_view key, std::string_view text);  ///< quoted
  YamlText& value(std::string_view key, const char* text) { return value(key, std::string_view(text)); }
  YamlText& counts(std::span<const std::pair<std::string_view, std::uint64_t>> counts);

  /// What follows belongs to it, until the next section or `top`.
  YamlText& section(std::string_view name);
  YamlText& top();

  const std::string& text() const { return text_; }

 private:
  YamlText& line(std::string_view key, std::string_view rest);

  std::string text_;
  bool in_section_ = false;
};

}  // namespace cosight::outbox
