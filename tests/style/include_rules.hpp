#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cosight {

/// Contents by path relative to the repository.
using SourceTree = std::map<std::filesystem::path, std::string>;

/// One line `#include "name"` or `#include <name>`.
struct Include {
  int line = 0;
  std::string name;
  bool is_own = false;  ///< in quotes
};
std::vector<Include> includes_in(const std::string& content);

/// The table of who may include whom (include_rules.txt), and the check of a tree against it.
class IncludeRules {
 public:
  /// Throws std::runtime_error with the line that makes no sense.
  static IncludeRules parse(std::string_view text);

  /// One sentence for each include that breaks a rule.
  std::vector<std::string> breaches(const SourceTree& tree) const;

  /// The innermost room that the file lies in; nothing outside of all rooms.
  std::optional<std::string> room_of(const std::filesystem::path& file) const;

 private:
  struct Library {
    std::string name;
    std::vector<std::string> beginnings;
  };
  struct Room {
    std::set<std::string> rooms;
    std::map<std::string, bool> libraries;  ///< name -> only inside the room
  };

  void read_library(const std::string& line);
  void read_room(const std::string& line);
  std::optional<std::string> library_of(const std::string& header) const;
  std::optional<std::string> breach_of_own(const std::string& room, const std::string& header) const;
  std::optional<std::string> breach_of_foreign(const std::string& room, const std::string& header,
                                               bool is_exposed) const;
  std::set<std::string> exposed_headers(const SourceTree& tree) const;

  std::vector<Library> libraries_;
  std::map<std::string, Room> rooms_;
};

}  // namespace cosight
