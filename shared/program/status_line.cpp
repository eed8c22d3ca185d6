#include "shared/program/status_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

namespace cosight {
namespace {

constexpr const char* kStartAndErase = "\r\x1b[K";

std::size_t columns(int file) {
  constexpr std::size_t kUsual = 80;
  winsize size{};
  return ::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsual;
}

}  // namespace

StatusLine::StatusLine(int file) : file_(file), is_visible_(::isatty(file) != 0) {}

StatusLine::~StatusLine() {
  clear();
}

void StatusLine::show(const std::string& text) {
  if (!is_visible_) return;
  write(kStartAndErase + text.substr(0, columns(file_) - 1));
  is_dirty_ = true;
}

void StatusLine::clear() {
  if (is_dirty_) write(kStartAndErase);
  is_dirty_ = false;
}

void StatusLine::write(const std::string& text) const {
  // A terminal that takes nothing loses the line: not worth an error.
  [[maybe_unused]] const auto written = ::write(file_, text.data(), text.size());
}

}  // namespace cosight
