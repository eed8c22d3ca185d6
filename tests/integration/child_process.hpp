#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace cosight::integration {

/// What a program left behind.
struct Ending {
  int exit_code = -1;  ///< 128 + signal when one killed it, as in a shell
  std::string out;
  std::string err;
};

/// A running program whose two streams go into files, as in a pipe: no terminal. Killed when it goes out of
/// scope.
class ChildProcess {
 public:
  /// `streams`: path without an extension; `.out` and `.err` are written there.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments,
               std::filesystem::path streams);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  void send(int signal) const;
  bool is_running();

  /// Waits for its end; kills it when `patience` is over, which shows as 137.
  Ending wait(std::chrono::milliseconds patience = std::chrono::seconds{60});

  std::string err() const;

 private:
  std::filesystem::path stream(const char* extension) const;
  bool has_ended(std::chrono::milliseconds patience);

  std::filesystem::path streams_;
  pid_t process_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

std::string text_of(const std::filesystem::path& file);

}  // namespace cosight::integration
