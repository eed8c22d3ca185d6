#include "shared/program/program.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>
#include <csignal>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <utility>

namespace cosight {
namespace {

// The one global: a signal handler can reach nothing else.
std::atomic<bool> stop_requested = false;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

extern "C" void request_stop(int /*signal*/) {
  stop_requested = true;
}

}  // namespace

void log_to_stderr(const std::string& level) {
  auto logger = spdlog::stderr_color_mt("cosight");
  logger->set_pattern(::isatty(STDERR_FILENO) != 0 ? "\r\x1b[K[%H:%M:%S] %^%l%$: %v"
                                                   : "[%H:%M:%S.%e] %l: %v");
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(std::move(logger));
}

struct Program::Shortcut {
  std::string flag;
  std::string key;
  std::string value;
  bool is_set = false;
};

Program::Program(ProgramDescription description)
    : description_(std::move(description)),
      app_(std::make_unique<CLI::App>(description_.purpose, description_.name)) {
  app_->footer("Examples:\n" + description_.examples);
  app_->set_version_flag("--version", description_.name + " " COSIGHT_VERSION);
  app_->add_option("--config", config_, "configuration (yaml); without one every key has its default")
      ->type_name("FILE");
  app_->add_option("--set", assignments_, "replaces one key of the configuration; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app_->add_option("--log-level", log_level_, "trace, debug, info, warning, error or off")
      ->check(CLI::IsMember({"trace", "debug", "info", "warning", "error", "off"}))
      ->type_name("LEVEL");
}

Program::~Program() = default;

Program& Program::option(const std::string& flag, const std::string& key, const std::string& help) {
  auto& shortcut = *shortcuts_.emplace_back(std::make_unique<Shortcut>(Shortcut{flag, key, "", false}));
  const auto take = [&shortcut](const std::string& value) {
    shortcut.value = value;
    shortcut.is_set = true;
  };
  app_->add_option_function<std::string>(flag, take, help + " (" + key + ")")->type_name("VALUE");
  return *this;
}

Program& Program::flag(const std::string& flag, const std::string& key, const std::string& help) {
  auto& shortcut = *shortcuts_.emplace_back(std::make_unique<Shortcut>(Shortcut{flag, key, "true", false}));
  app_->add_flag_callback(
      flag, [&shortcut] { shortcut.is_set = true; }, help + " (" + key + ")");
  return *this;
}

CLI::App& Program::command_line() {
  return *app_;
}

ConfigFile Program::load_config() const {
  std::vector<ConfigOverride> overrides;
  for (const auto& assignment : assignments_)
    overrides.push_back(parse_override(assignment));
  for (const auto& shortcut : shortcuts_) {
    if (shortcut->is_set) overrides.push_back({shortcut->key, shortcut->value, shortcut->flag, true});
  }
  if (config_.empty()) return ConfigFile::parse("", "defaults", overrides);
  return ConfigFile::load(config_, overrides);
}

int Program::report(const std::string& sentence, ExitCode code) const {
  std::fprintf(stderr, "%s: %s\n", description_.name.c_str(), sentence.c_str());
  return static_cast<int>(code);
}

int Program::run(int argc, char** argv,
                 const std::function<ExitCode(const ConfigFile&, const std::atomic<bool>&)>& body) {
  try {
    app_->parse(argc, argv);
    log_to_stderr(log_level_);
    const auto& stop = stop_on_signals();
    return static_cast<int>(body(load_config(), stop));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_->exit(error);  // --help, --version
    return report(std::string(error.what()) + "; see " + description_.name + " --help", ExitCode::kUsage);
  } catch (const ConfigError& error) {
    return report(error.what(), ExitCode::kUsage);
  } catch (const std::exception& error) {
    return report(error.what(), ExitCode::kFailed);
  }
}

const std::atomic<bool>& stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigemptyset(&action.sa_mask);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  return stop_requested;
}

}  // namespace cosight
