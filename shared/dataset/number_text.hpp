#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/dataset/stamp.hpp"

namespace cosight {

std::string_view trimmed(std::string_view text);

/// The parts of a line between commas, trimmed; an empty one stays.
std::vector<std::string_view> split_at_commas(std::string_view line);

/// The parts of a line between blanks and tabs.
std::vector<std::string_view> split_at_blanks(std::string_view line);

/// The whole text as one finite number; nothing for anything else ("nan", "1.2x", "").
std::optional<double> parse_number(std::string_view text);

/// Seconds as TUM files write them, "1403715285.262143135", kept to the nanosecond (a double holds such a
/// time to 0.2 us only). Nothing when it is no finite number, or beyond what a Stamp holds.
std::optional<Stamp> parse_seconds(std::string_view text);

/// Whole nanoseconds.
std::optional<Stamp> parse_nanoseconds(std::string_view text);

/// The inverse of parse_seconds: nine decimals.
std::string seconds_text(Stamp stamp);

}  // namespace cosight
