#pragma once

#include <cstdint>
#include <filesystem>

namespace cosight::outbox {

struct RunFolderOptions {
  bool link_latest = false;                    ///< a symbolic link `latest` beside the folder points to it
  std::uintmax_t min_free_bytes = 16'000'000;  ///< refuse to start with less; an hour needs about 60 MB
};

/// The folder of one run. Never one that holds an earlier run: `runs/kitti` becomes `runs/kitti-2`, `-3` …
/// until a name is free or its folder empty.
class RunFolder {
 public:
  /// Creates it, with its parents, and proves by a file that it can be written. Throws OutputError.
  explicit RunFolder(const std::filesystem::path& wanted, const RunFolderOptions& options = {});

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const char* name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace cosight::outbox
