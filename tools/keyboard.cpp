#include "tools/keyboard.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <utility>

namespace cosight {

struct Keyboard::Terminal {
  termios before{};
};

Keyboard::Keyboard(std::function<void(char)> press) {
  if (::isatty(STDIN_FILENO) == 0) return;
  terminal_ = std::make_unique<Terminal>();
  ::tcgetattr(STDIN_FILENO, &terminal_->before);
  termios keys = terminal_->before;
  keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
  ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
  thread_ = std::thread([this, press = std::move(press)] { listen(press); });
}

Keyboard::~Keyboard() {
  done_ = true;
  if (thread_.joinable()) thread_.join();
  if (terminal_) ::tcsetattr(STDIN_FILENO, TCSANOW, &terminal_->before);
}

void Keyboard::listen(const std::function<void(char)>& press) const {
  constexpr int kSlice = 50;  // [ms]
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!done_) {
    if (::poll(&input, 1, kSlice) <= 0) continue;
    char key = 0;
    if (::read(STDIN_FILENO, &key, 1) != 1) return;
    press(key);
  }
}

}  // namespace cosight
