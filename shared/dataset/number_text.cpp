#include "shared/dataset/number_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace cosight {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr Stamp kMaxSeconds = std::numeric_limits<Stamp>::max() / kNanosecondsPerSecond - 1;
constexpr std::size_t kNanosecondDigits = 9;

std::optional<Stamp> parse_integer(std::string_view text) {
  Stamp value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "262143135" or shorter, as the digits behind a decimal point [ns].
std::optional<Stamp> parse_fraction(std::string_view digits) {
  if (digits.empty()) return 0;
  if (digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
  std::string padded(digits.substr(0, kNanosecondDigits));
  padded.resize(kNanosecondDigits, '0');
  return parse_integer(padded);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string_view> split_at_commas(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

std::vector<std::string_view> split_at_blanks(std::string_view line) {
  std::vector<std::string_view> parts;
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    parts.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return parts;
}

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Stamp> parse_seconds(std::string_view text) {
  const std::optional<double> rough = parse_number(text);
  if (!rough || std::abs(*rough) > static_cast<double>(kMaxSeconds)) return std::nullopt;
  const bool negative = text.front() == '-';
  const std::string_view digits = text.substr(negative ? 1 : 0);
  const std::size_t point = digits.find('.');
  std::string whole = "0";  // because ".5" is a number too
  whole += digits.substr(0, point);
  const std::optional<Stamp> seconds = parse_integer(whole);
  const std::optional<Stamp> fraction =
      parse_fraction(point == std::string_view::npos ? std::string_view{} : digits.substr(point + 1));
  if (!seconds || !fraction) return from_seconds(*rough);  // "1.403e9": as exact as a double
  const Stamp stamp = *seconds * kNanosecondsPerSecond + *fraction;
  return negative ? -stamp : stamp;
}

std::optional<Stamp> parse_nanoseconds(std::string_view text) {
  return parse_integer(text);
}

std::string seconds_text(Stamp stamp) {
  const Stamp magnitude = stamp < 0 ? -stamp : stamp;
  std::array<char, 40> text{};
  const int length = std::snprintf(text.data(), text.size(), "%s%lld.%09lld", stamp < 0 ? "-" : "",
                                   static_cast<long long>(magnitude / kNanosecondsPerSecond),
                                   static_cast<long long>(magnitude % kNanosecondsPerSecond));
  return {text.data(), static_cast<std::size_t>(length)};
}

}  // namespace cosight
