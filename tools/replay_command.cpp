#include "tools/replay_command.hpp"

#include <sys/prctl.h>

#include <atomic>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "shared/program/program.hpp"
#include "shared/program/status_line.hpp"
#include "shared/recording/replayer.hpp"
#include "tools/dds_arguments.hpp"
#include "tools/keyboard.hpp"

namespace cosight {
namespace {

using recording::ReplayControl;
using recording::ReplaySummary;

struct ReplayArguments {
  std::filesystem::path file;
  recording::ReplayerOptions replay;
  transport::ParticipantOptions dds;
  std::vector<std::string> remaps;
  std::string log_level = "warning";
};

/// "/from:=/to", as ROS 2 writes it.
void read_remaps(ReplayArguments& arguments) {
  for (const std::string& remap : arguments.remaps) {
    const std::size_t at = remap.find(":=");
    if (at == std::string::npos || at == 0 || at + 2 == remap.size())
      throw CLI::ValidationError("--remap", "'" + remap + "' is not /from:=/to");
    arguments.replay.remap[remap.substr(0, at)] = remap.substr(at + 2);
  }
}

void press(char key, ReplayControl& control) {
  if (key == ' ') control.paused = !control.paused;
  if (key == 's' && control.paused) ++control.steps;
}

std::string status_text(const recording::ReplayerStatus& status) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(1) << to_seconds(status.position) << " s, " << status.sent
       << " messages" << (status.paused ? ", paused" : "") << "  [space: pause, s: step]";
  return text.str();
}

void report(const ReplaySummary& summary) {
  for (const std::string& sentence : summary.not_sent)
    std::cerr << "cosight replay: not sent: " << sentence << '\n';
  for (const std::string& topic : summary.without_reader)
    std::cerr << "cosight replay: nobody listens on " << topic << '\n';
  if (summary.damaged > 0)
    std::cerr << "cosight replay: " << summary.damaged << " damaged parts of the recording left out\n";
  const auto milliseconds = [](Stamp late) { return 1e3 * to_seconds(late); };
  std::cout << std::fixed << std::setprecision(3) << "sent " << summary.sent << " messages; late by "
            << milliseconds(summary.late_median) << " ms (median), " << milliseconds(summary.late_p99)
            << " ms (p99), " << milliseconds(summary.late_worst) << " ms (worst)\n";
}

void run(ReplayArguments arguments) {
  log_to_stderr(arguments.log_level);
  read_remaps(arguments);
  const std::atomic<bool>& stop = stop_on_signals();
  arguments.dds.name = "cosight_replay";
  const recording::McapReader reader(arguments.file);
  const transport::Participant participant(arguments.dds);
  SteadyClock clock;
  ::prctl(PR_SET_TIMERSLACK, 1UL);  // [ns]; 50 us otherwise, by which every message would be later
  recording::Replayer replayer(participant, reader, arguments.replay, clock);
  ReplayControl control;
  StatusLine line;
  ReplaySummary summary;
  {
    const Keyboard keyboard([&control](char key) { press(key, control); });
    summary = replayer.run(stop, control, [&](const recording::ReplayerStatus& status) {
      if (line.is_visible()) line.show(status_text(status));
    });
  }
  line.clear();
  report(summary);
  if (summary.failed + summary.damaged > 0 || !summary.not_sent.empty())
    throw CLI::RuntimeError(static_cast<int>(ExitCode::kDataLost));
}

void add_times(CLI::App& command, recording::ReplayerOptions& replay) {
  command.add_option("--rate", replay.rate, "times real time; 0: as fast as possible")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command.add_option("--start", replay.start, "seconds into the recording")->check(CLI::NonNegativeNumber);
  command.add_option("--end", replay.end, "seconds into the recording")->check(CLI::NonNegativeNumber);
  command.add_flag("--loop", replay.loop, "start again at the end");
}

void add_readers(CLI::App& command, recording::ReplayerOptions& replay) {
  command.add_option("--wait-for", replay.expected_readers,
                     "start when somebody listens on these topics; default: on any");
  command.add_option("--patience", replay.patience, "seconds to wait for listeners")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
}

}  // namespace

void add_replay_command(CLI::App& program) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = program.add_subcommand("replay", "send a recording into the DDS domain again");
  command->add_option("file", arguments->file, "MCAP file")->required()->check(CLI::ExistingFile);
  add_times(*command, arguments->replay);
  command->add_option("--topics", arguments->replay.topics.allow, "only these, with wildcards");
  command->add_option("--exclude", arguments->replay.topics.deny, "not these, with wildcards");
  command->add_option("--remap", arguments->remaps, "/from:=/to");
  add_readers(*command, arguments->replay);
  add_dds_options(*command, arguments->dds);
  command->add_option("--log-level", arguments->log_level, "trace, debug, info, warning, error or off")
      ->capture_default_str();
  command->footer("Example: cosight replay trial.mcap --rate 0.5 --domain 7");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
