#include "robot_agent/outbox/run_folder.hpp"

#include <fstream>
#include <string>
#include <system_error>

#include "robot_agent/outbox/output_error.hpp"

namespace cosight::outbox {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxNames = 10'000;

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": the run folder can't be used: " + reason +
                    "; choose another one or make room");
}

/// Creates `path`; false when it is taken by a folder that holds something, or by a file.
bool claim(const fs::path& path) {
  std::error_code error;
  if (fs::create_directory(path, error)) return true;
  if (error && error != std::errc::file_exists) fail(path, error.message());
  return fs::is_directory(path, error) && fs::is_empty(path, error) && !error;
}

fs::path claim_free_name(const fs::path& wanted) {
  if (claim(wanted)) return wanted;
  for (int number = 2; number <= kMaxNames; ++number) {
    fs::path numbered = wanted;
    numbered += "-" + std::to_string(number);
    if (claim(numbered)) return numbered;
  }
  fail(wanted, "ten thousand runs of that name exist already");
}

void prove_writable(const fs::path& folder) {
  const fs::path probe = folder / ".probe";
  std::ofstream file(probe, std::ios::binary);
  file << std::string(65'536, 'x');
  file.close();
  std::error_code error;
  fs::remove(probe, error);
  if (!file) fail(folder, "a file in it can't be written");
}

void require_free_bytes(const fs::path& folder, std::uintmax_t min_free_bytes) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error || space.available >= min_free_bytes) return;
  fail(folder, "only " + std::to_string(space.available / 1'000'000) + " MB are free, a run needs " +
                   std::to_string(min_free_bytes / 1'000'000) + " MB");
}

/// Convenience only, so that it fails silently. Replaces a link, never a file or folder of that name.
void link_as_latest(const fs::path& folder) {
  std::error_code error;
  const fs::path link = folder.parent_path() / "latest";
  if (fs::exists(fs::symlink_status(link, error)) && !fs::is_symlink(link, error)) return;
  const fs::path fresh = folder.parent_path() / (".latest-" + folder.filename().string());
  fs::create_directory_symlink(folder.filename(), fresh, error);
  if (!error) fs::rename(fresh, link, error);
}

}  // namespace

RunFolder::RunFolder(const fs::path& wanted, const RunFolderOptions& options) {
  std::error_code error;
  fs::path clean = fs::absolute(wanted, error).lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();  // "runs/kitti/"
  fs::create_directories(clean.parent_path(), error);
  if (error) fail(clean, error.message());
  path_ = claim_free_name(clean);
  require_free_bytes(path_, options.min_free_bytes);
  prove_writable(path_);
  if (options.link_latest) link_as_latest(path_);
}

}  // namespace cosight::outbox
