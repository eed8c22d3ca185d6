#include "shared/program/program.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <functional>
#include <stdexcept>

namespace cosight {
namespace {

using testing::HasSubstr;

struct Ending {
  int status = -1;  ///< exit code, or minus the signal
  std::string output;
  std::string errors;
};

std::string all_of(int pipe) {
  std::string text;
  char buffer[4096];
  for (ssize_t n = ::read(pipe, buffer, sizeof buffer); n > 0; n = ::read(pipe, buffer, sizeof buffer)) {
    text.append(buffer, static_cast<std::size_t>(n));
  }
  ::close(pipe);
  return text;
}

using Body = std::function<ExitCode(const ConfigFile&, const std::atomic<bool>&)>;

/// Runs a program in a process of its own: it sets signal handlers and ends with an exit code.
Ending run(std::vector<std::string> arguments, const Body& body) {
  int output[2];
  int errors[2];
  if (::pipe(output) != 0 || ::pipe(errors) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::dup2(output[1], STDOUT_FILENO);
    ::dup2(errors[1], STDERR_FILENO);
    ::close(output[0]);
    ::close(errors[0]);
    arguments.insert(arguments.begin(), "example");
    std::vector<char*> argv;
    for (auto& argument : arguments)
      argv.push_back(argument.data());
    Program program({.name = "example", .purpose = "Shows an edge.", .examples = "  example --rate 2\n"});
    program.option("--rate", "replay.rate", "times real time").flag("--loop", "replay.loop", "starts again");
    const int status = program.run(static_cast<int>(argv.size()), argv.data(), body);
    std::fflush(nullptr);
    ::_exit(status);
  }
  ::close(output[1]);
  ::close(errors[1]);
  Ending ending;
  ending.output = all_of(output[0]);
  ending.errors = all_of(errors[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  ending.status = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  return ending;
}

ExitCode read_rate(const ConfigFile& config, const std::atomic<bool>& /*stop*/) {
  const ConfigNode replay = config.root().section("replay");
  std::printf("rate %g loop %d\n", replay.number("rate", 1.0, 0.0, 100.0),
              replay.boolean("loop", false) ? 1 : 0);
  config.refuse_unknown_keys();
  return ExitCode::kDone;
}

TEST(Program, HelpShowsTheOptionsTheirKeysAndExamples) {
  const Ending ending = run({"--help"}, read_rate);
  EXPECT_EQ(ending.status, 0);
  EXPECT_THAT(ending.output, HasSubstr("Shows an edge."));
  EXPECT_THAT(ending.output, HasSubstr("times real time (replay.rate)"));
  EXPECT_THAT(ending.output, HasSubstr("example --rate 2"));
}

TEST(Program, VersionIsOneLine) {
  const Ending ending = run({"--version"}, read_rate);
  EXPECT_EQ(ending.status, 0);
  EXPECT_THAT(ending.output, testing::MatchesRegex("example [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

TEST(Program, OptionsAndSetReplaceTheConfiguration) {
  EXPECT_EQ(run({}, read_rate).output, "rate 1 loop 0\n");
  EXPECT_EQ(run({"--rate", "2", "--loop"}, read_rate).output, "rate 2 loop 1\n");
  EXPECT_EQ(run({"--set", "replay.rate=3", "--set", "replay.loop=true"}, read_rate).output,
            "rate 3 loop 1\n");
}

TEST(Program, WhatTheUserGotWrongEndsWithTwoAndOneLine) {
  const Ending range = run({"--rate", "-1"}, read_rate);
  EXPECT_EQ(range.status, 2);
  EXPECT_EQ(range.errors, "example: --rate: replay.rate: -1 is not in [0, 100]; leave it out for 1\n");
  const Ending option = run({"--rat", "1"}, read_rate);
  EXPECT_EQ(option.status, 2);
  EXPECT_THAT(option.errors, HasSubstr("--rat"));
  EXPECT_THAT(option.errors, HasSubstr("see example --help"));
  const Ending file = run({"--config", "/no/such.yaml"}, read_rate);
  EXPECT_EQ(file.status, 2);
  EXPECT_EQ(file.errors, "example: /no/such.yaml: can't be read; check the path\n");
  const Ending key = run({"--set", "replay.rat=1"}, read_rate);
  EXPECT_EQ(key.status, 2);
  EXPECT_THAT(key.errors, HasSubstr("did you mean rate?"));
}

TEST(Program, WhatFailsOutsideEndsWithOneAndOneLine) {
  const Ending ending = run({}, [](const ConfigFile&, const std::atomic<bool>&) -> ExitCode {
    throw std::runtime_error("disk full");
  });
  EXPECT_EQ(ending.status, 1);
  EXPECT_EQ(ending.errors, "example: disk full\n");
}

TEST(Program, TheBodySaysThatDataWasLost) {
  EXPECT_EQ(run({}, [](const ConfigFile&, const std::atomic<bool>&) { return ExitCode::kDataLost; }).status,
            3);
}

TEST(Program, ASignalSetsTheFlagAndASecondOneEndsTheProcess) {
  const Ending first = run({}, [](const ConfigFile&, const std::atomic<bool>& stop) {
    ::raise(SIGTERM);
    std::printf("stop %d\n", stop ? 1 : 0);
    return ExitCode::kDone;
  });
  EXPECT_EQ(first.status, 0);
  EXPECT_EQ(first.output, "stop 1\n");
  const Ending second = run({}, [](const ConfigFile&, const std::atomic<bool>&) {
    ::raise(SIGINT);
    ::raise(SIGINT);
    return ExitCode::kDone;
  });
  EXPECT_EQ(second.status, -SIGINT);
}

}  // namespace
}  // namespace cosight
