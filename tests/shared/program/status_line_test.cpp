#include "shared/program/status_line.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>

namespace cosight {
namespace {

std::string read_some(int file) {
  char buffer[512];
  const auto count = ::read(file, buffer, sizeof buffer);
  return count > 0 ? std::string(buffer, static_cast<std::size_t>(count)) : "";
}

TEST(StatusLine, RewritesOneLineOfATerminalAndCutsItToItsWidth) {
  const int master = ::posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_GE(master, 0);
  ASSERT_EQ(::grantpt(master), 0);
  ASSERT_EQ(::unlockpt(master), 0);
  const int terminal = ::open(::ptsname(master), O_RDWR | O_NOCTTY);  // NOLINT(concurrency-mt-unsafe)
  ASSERT_GE(terminal, 0);
  const winsize size{.ws_row = 24, .ws_col = 10, .ws_xpixel = 0, .ws_ypixel = 0};
  ASSERT_EQ(::ioctl(terminal, TIOCSWINSZ, &size), 0);
  {
    StatusLine line(terminal);
    EXPECT_TRUE(line.is_visible());
    line.show("0123456789abc");
    EXPECT_EQ(read_some(master), "\r\x1b[K012345678");
    line.show("short");
    EXPECT_EQ(read_some(master), "\r\x1b[Kshort");
  }
  EXPECT_EQ(read_some(master), "\r\x1b[K") << "the line goes when the program does";
  ::close(terminal);
  ::close(master);
}

TEST(StatusLine, WritesNothingIntoAPipe) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  {
    StatusLine line(ends[1]);
    EXPECT_FALSE(line.is_visible());
    line.show("text");
  }
  ::close(ends[1]);
  EXPECT_EQ(read_some(ends[0]), "");
  ::close(ends[0]);
}

}  // namespace
}  // namespace cosight
