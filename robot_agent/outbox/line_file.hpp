#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cosight::outbox {

/// A text file that grows line by line. Each line is handed to the system at once, so that a killed process
/// loses at most the last one. When the disk is full, lines wait (bounded) for room; what finds none is
/// counted, and the file's lines stay whole.
class LineFile {
 public:
  /// Throws OutputError.
  explicit LineFile(std::filesystem::path path);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// `line` without its end.
  void append(std::string_view line);

  /// Writes what waits, closes, and counts what still found no room as lost.
  void close();

  const std::filesystem::path& path() const { return path_; }
  std::uint64_t lost_lines() const { return lost_lines_; }
  /// What is missing and why, in a sentence; nothing when all lines went out.
  std::optional<std::string> loss() const;
  /// Why the last write failed; empty while all is well.
  const std::string& failure() const { return failure_; }

 private:
  void write_waiting();

  std::filesystem::path path_;
  int descriptor_ = -1;
  std::string waiting_;
  std::uint64_t lost_lines_ = 0;
  std::string failure_;
};

}  // namespace cosight::outbox
