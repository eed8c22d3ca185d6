#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string>

#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::transport {

/// What a peer printed: name and value.
using Fields = std::map<std::string, std::string>;

/// cyclone_peer in a process of its own; what it prints goes to a file.
class CyclonePeer {
 public:
  explicit CyclonePeer(std::string mode)
      : output_(::testing::TempDir() + "cyclone_" + std::to_string(getpid())) {
    setenv("CYCLONEDDS_URI",
           "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
           "multicast=\"true\"/></Interfaces>"
           "</General><Internal><SocketReceiveBufferSize min=\"1MB\"/></Internal></Domain></CycloneDDS>",
           1);
    std::string program = COSIGHT_BINARY_DIR "/tests/cyclone_peer";
    std::string domain = std::to_string(own_domain());
    std::array<char*, 4> arguments = {program.data(), mode.data(), domain.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) throw std::runtime_error("can't start " + program);
  }
  ~CyclonePeer() {
    if (process_ > 0) {
      kill(process_, SIGKILL);
      waitpid(process_, nullptr, 0);
    }
    std::remove(output_.c_str());
  }
  CyclonePeer(const CyclonePeer&) = delete;
  CyclonePeer& operator=(const CyclonePeer&) = delete;

  /// Its exit status; it gives up by itself after 20 s.
  int wait() {
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  Fields printed() const {
    Fields fields;
    std::ifstream file(output_);
    std::string line;
    while (std::getline(file, line)) {
      const std::size_t space = line.find(' ');
      if (space != std::string::npos) fields[line.substr(0, space)] = line.substr(space + 1);
    }
    return fields;
  }

 private:
  std::string output_;
  pid_t process_ = 0;
};

}  // namespace cosight::transport
