#include "robot_agent/outbox/line_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "robot_agent/outbox/output_error.hpp"

namespace cosight::outbox {
namespace {

constexpr std::size_t kMaxWaitingBytes = 4'000'000;

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

}  // namespace

LineFile::LineFile(std::filesystem::path path)
    : path_(std::move(path)),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0644)) {
  if (descriptor_ < 0) throw OutputError(path_.string() + ": can't be created: " + reason_of(errno));
}

LineFile::~LineFile() {
  close();
}

void LineFile::append(std::string_view line) {
  if (descriptor_ < 0 || waiting_.size() + line.size() >= kMaxWaitingBytes) {
    ++lost_lines_;
    return;
  }
  waiting_.append(line);
  waiting_.push_back('\n');
  write_waiting();
}

void LineFile::close() {
  if (descriptor_ < 0) return;
  write_waiting();
  lost_lines_ += static_cast<std::uint64_t>(std::count(waiting_.begin(), waiting_.end(), '\n'));
  waiting_.clear();
  if (::close(descriptor_) != 0) failure_ = reason_of(errno);
  descriptor_ = -1;
}

std::optional<std::string> LineFile::loss() const {
  if (lost_lines_ == 0) return std::nullopt;
  return path_.string() + ": " + std::to_string(lost_lines_) +
         " lines are missing: " + (failure_.empty() ? "the disk was full for too long" : failure_);
}

/// A line that only went out in part goes on where it stopped at the next attempt.
void LineFile::write_waiting() {
  std::size_t written = 0;
  failure_.clear();
  while (written < waiting_.size()) {
    const ssize_t count = ::write(descriptor_, waiting_.data() + written, waiting_.size() - written);
    if (count > 0) {
      written += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      failure_ = count == 0 ? "nothing was written" : reason_of(errno);
      break;
    }
  }
  waiting_.erase(0, written);
}

}  // namespace cosight::outbox
