#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <thread>

namespace cosight {

/// Keys as they are pressed, without Enter, when stdin is a terminal; else nothing ever comes.
class Keyboard {
 public:
  /// `press` runs in a thread of its own until the destructor returns.
  explicit Keyboard(std::function<void(char)> press);
  ~Keyboard();
  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

 private:
  void listen(const std::function<void(char)>& press) const;

  struct Terminal;
  std::unique_ptr<Terminal> terminal_;
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

}  // namespace cosight
