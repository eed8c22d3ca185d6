#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "shared/config/config.hpp"

namespace CLI {
class App;
}

namespace cosight {

/// What a shell learns from a program's end, the same for all of Cosight's.
enum class ExitCode {
  kDone = 0,
  kFailed = 1,    ///< something outside failed: a file, a device, the network
  kUsage = 2,     ///< the command line or the configuration can't be used
  kDataLost = 3,  ///< it went to the end, but not all data did
};

struct ProgramDescription {
  std::string name;
  std::string purpose;   ///< one sentence
  std::string examples;  ///< the footer of --help, lines of commands
};

/// The edge of a program to the shell: --help with examples, --version, --config FILE, --set KEY=VALUE,
/// --log-level; log lines on stderr; SIGINT and SIGTERM as a flag; each error as one line with its exit code.
class Program {
 public:
  explicit Program(ProgramDescription description);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// An option that stands for a key of the configuration: `option("--rate", "replay.rate", "times real
  /// time")`.
  Program& option(const std::string& flag, const std::string& key, const std::string& help);

  /// An option without a value that sets a key to true.
  Program& flag(const std::string& flag, const std::string& key, const std::string& help);

  /// For options that are no keys of the configuration, and subcommands.
  CLI::App& command_line();

  /// Parses, reads the configuration, and runs `body` until it returns or throws. `stop` becomes true at the
  /// first SIGINT or SIGTERM; a second one ends the process the hard way. `body` calls
  /// `config.refuse_unknown_keys()` when it has read everything.
  int run(int argc, char** argv,
          const std::function<ExitCode(const ConfigFile& config, const std::atomic<bool>& stop)>& body);

 private:
  struct Shortcut;

  ConfigFile load_config() const;
  int report(const std::string& sentence, ExitCode code) const;

  ProgramDescription description_;
  std::unique_ptr<CLI::App> app_;
  std::vector<std::unique_ptr<Shortcut>> shortcuts_;
  std::string config_;
  std::vector<std::string> assignments_;
  std::string log_level_ = "info";
};

/// Log lines go to stderr from now on, so that stdout carries results only; over a status line when there is
/// one. `level`: as for --log-level.
void log_to_stderr(const std::string& level);

/// The flag that SIGINT and SIGTERM set, from now on. Once a process; the second signal of a kind has its
/// usual effect.
const std::atomic<bool>& stop_on_signals();

}  // namespace cosight
