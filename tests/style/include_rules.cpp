#include "tests/style/include_rules.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace cosight {
namespace {

constexpr std::string_view kInside = "(inside)";

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;)
    words.push_back(word);
  return words;
}

bool is_standard(const std::string& header) {
  return header.find('/') == std::string::npos && header.find('.') == std::string::npos;
}

}  // namespace

std::vector<Include> includes_in(const std::string& content) {
  static const std::regex include(R"re(^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"])re");
  std::vector<Include> includes;
  std::istringstream lines(content);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::smatch match;
    if (line.find('#') == std::string::npos || !std::regex_search(line, match, include)) continue;
    includes.push_back({number, match[2], match[1] == "\""});
  }
  return includes;
}

IncludeRules IncludeRules::parse(std::string_view text) {
  IncludeRules rules;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line.front() == '#') continue;
    if (line.starts_with("library ")) {
      rules.read_library(line);
    } else if (line.starts_with("room ")) {
      rules.read_room(line);
    } else {
      throw std::runtime_error("include_rules.txt: neither a library nor a room: " + line);
    }
  }
  return rules;
}

void IncludeRules::read_library(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  if (words.size() < 3) throw std::runtime_error("include_rules.txt: a library without headers: " + line);
  libraries_.push_back({words[1], {words.begin() + 2, words.end()}});
}

void IncludeRules::read_room(const std::string& line) {
  const std::size_t bar = line.find('|');
  const std::vector<std::string> own = words_of(line.substr(0, bar));
  if (bar == std::string::npos || own.size() < 2) {
    throw std::runtime_error("include_rules.txt: a room needs 'room PATH … | …': " + line);
  }
  Room& room = rooms_[own[1]];
  room.rooms.insert(own.begin() + 2, own.end());
  for (std::string word : words_of(line.substr(bar + 1))) {
    const bool only_inside = word.ends_with(kInside);
    if (only_inside) word.resize(word.size() - kInside.size());
    room.libraries[word] = only_inside;
  }
}

std::optional<std::string> IncludeRules::room_of(const std::filesystem::path& file) const {
  for (std::filesystem::path folder = file.parent_path(); !folder.empty(); folder = folder.parent_path()) {
    if (rooms_.contains(folder.generic_string())) return folder.generic_string();
  }
  return std::nullopt;
}

std::optional<std::string> IncludeRules::library_of(const std::string& header) const {
  for (const Library& library : libraries_) {
    const bool found =
        std::any_of(library.beginnings.begin(), library.beginnings.end(),
                    [&](const std::string& beginning) { return header.starts_with(beginning); });
    if (found) return library.name;
  }
  return std::nullopt;
}

std::optional<std::string> IncludeRules::breach_of_own(const std::string& room,
                                                       const std::string& header) const {
  const std::optional<std::string> other = room_of(header);
  if (!other)
    return "includes \"" + header + "\", which lies in no room; write it from the repository's root";
  if (*other == room || rooms_.at(room).rooms.contains(*other)) return std::nullopt;
  return "includes \"" + header + "\", but " + room + " may not know " + *other;
}

std::optional<std::string> IncludeRules::breach_of_foreign(const std::string& room, const std::string& header,
                                                           bool is_exposed) const {
  if (is_standard(header)) return std::nullopt;
  const std::optional<std::string> library = library_of(header);
  if (!library) return "includes <" + header + ">, which belongs to no library in include_rules.txt";
  const auto allowed = rooms_.at(room).libraries.find(*library);
  if (allowed == rooms_.at(room).libraries.end()) {
    return "includes <" + header + ">, but " + room + " may not use " + *library;
  }
  if (allowed->second && is_exposed) {
    return "includes <" + header + ">, and other rooms include this header; " + room + " keeps " + *library +
           " to itself";
  }
  return std::nullopt;
}

/// Headers that files of another room include, and what those headers pull in from their own room.
std::set<std::string> IncludeRules::exposed_headers(const SourceTree& tree) const {
  std::vector<std::string> waiting;
  for (const auto& [file, content] : tree) {
    for (const Include& include : includes_in(content)) {
      if (include.is_own && room_of(include.name) != room_of(file)) waiting.push_back(include.name);
    }
  }
  std::set<std::string> exposed;
  while (!waiting.empty()) {
    const std::string header = waiting.back();
    waiting.pop_back();
    const auto found = tree.find(header);
    if (found == tree.end() || !exposed.insert(header).second) continue;
    for (const Include& include : includes_in(found->second)) {
      if (include.is_own) waiting.push_back(include.name);
    }
  }
  return exposed;
}

std::vector<std::string> IncludeRules::breaches(const SourceTree& tree) const {
  const std::set<std::string> exposed = exposed_headers(tree);
  std::vector<std::string> sentences;
  for (const auto& [file, content] : tree) {
    const std::optional<std::string> room = room_of(file);
    if (!room) {
      sentences.push_back(file.generic_string() + " lies in no room of include_rules.txt");
      continue;
    }
    for (const Include& include : includes_in(content)) {
      const bool is_exposed = exposed.contains(file.generic_string());
      const auto breach = include.is_own ? breach_of_own(*room, include.name)
                                         : breach_of_foreign(*room, include.name, is_exposed);
      if (breach)
        sentences.push_back(file.generic_string() + ":" + std::to_string(include.line) + " " + *breach);
    }
  }
  return sentences;
}

}  // namespace cosight
