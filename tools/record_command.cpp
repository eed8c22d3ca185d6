#include "tools/record_command.hpp"

#include <sys/utsname.h>
#include <unistd.h>
#include <csignal>

#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <memory>
#include <sstream>

#include "shared/program/program.hpp"
#include "shared/program/status_line.hpp"
#include "shared/recording/recorder.hpp"
#include "shared/recording/recording_error.hpp"
#include "tools/dds_arguments.hpp"

namespace cosight {
namespace {

using recording::Compression;
using recording::RecorderOptions;
using recording::RecorderStatus;

constexpr int kDataLost = static_cast<int>(ExitCode::kDataLost);

struct RecordArguments {
  RecorderOptions recorder;
  transport::ParticipantOptions dds;
  std::vector<std::string> schema_folders;
  std::vector<std::string> attachments;
  std::string compression = "zstd";
  double split_mb = 0.0;
  double split_seconds = 0.0;
  std::string log_level = "warning";
};

// The one global: a signal handler can reach nothing else.
std::atomic<int> save_requests = 0;  // NOLINT(cppcoreguidelines-avoid-non-const-global-variables)
static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may not lock");

extern "C" void request_save(int /*signal*/) {
  ++save_requests;
}

Stamp wall_clock() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

recording::Attachment attachment_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw recording::RecordingError("attachment " + path.string() + " can't be read");
  recording::Attachment attachment;
  attachment.log_time = attachment.create_time = wall_clock();
  attachment.name = path.filename().string();
  attachment.media_type = path.extension() == ".yaml"  ? "application/yaml"
                          : path.extension() == ".xml" ? "application/xml"
                                                       : "application/octet-stream";
  attachment.data.assign(std::istreambuf_iterator<char>(file), {});
  return attachment;
}

recording::SessionNotes session_notes(const RecordArguments& arguments) {
  recording::SessionNotes notes;
  for (const std::string& path : arguments.attachments)
    notes.attachments.push_back(attachment_of(path));
  if (!arguments.dds.profile_file.empty())
    notes.attachments.push_back(attachment_of(arguments.dds.profile_file));
  utsname machine{};
  ::uname(&machine);
  notes.session = {"cosight.session",
                   {{"cosight", COSIGHT_VERSION},
                    {"host", machine.nodename},
                    {"system", std::string(machine.sysname) + " " + machine.release + " " + machine.machine},
                    {"dds_domain", std::to_string(arguments.dds.domain)},
                    {"started_ns", std::to_string(wall_clock())}}};
  return notes;
}

std::string status_text(const RecorderStatus& status) {
  std::ostringstream text;
  text.precision(1);
  text << std::fixed << status.topics << " topics, " << status.counters.received << " messages, "
       << static_cast<double>(status.bytes_written) / 1e6 << " MB, "
       << status.counters.lost + status.counters.refused << " lost";
  if (status.saved > 0) text << ", " << status.saved << " rings saved";
  return text.str();
}

void report(const recording::RecordedSummary& summary) {
  for (const auto& path : summary.files)
    std::cout << path.string() << '\n';
  for (const std::string& sentence : summary.unrecorded)
    std::cerr << "cosight record: not recorded: " << sentence << '\n';
  std::cerr << "cosight record: " << summary.messages << " messages, " << summary.counters.lost
            << " lost on the way, " << summary.counters.refused << " because the disk was too slow\n";
}

void run(RecordArguments arguments) {
  log_to_stderr(arguments.log_level);
  const std::atomic<bool>& stop = stop_on_signals();
  std::signal(SIGUSR1, request_save);
  auto& options = arguments.recorder;
  options.writer.compression =
      recording::compression_named(arguments.compression == "none" ? "" : arguments.compression).value();
  options.split = {static_cast<std::uint64_t>(arguments.split_mb * 1e6),
                   from_seconds(arguments.split_seconds)};
  auto schemas = recording::MessageSchemas::built_in();
  for (const std::string& folder : arguments.schema_folders)
    schemas.add_folder(folder);
  arguments.dds.name = "cosight_record";
  const transport::Participant participant(arguments.dds);
  recording::Recorder recorder(participant, options, std::move(schemas), session_notes(arguments));
  StatusLine line;
  const auto summary = recorder.run(stop, save_requests, [&](const RecorderStatus& status) {
    if (line.is_visible()) line.show(status_text(status));
  });
  line.clear();
  report(summary);
  if (summary.counters.lost + summary.counters.refused > 0 || !summary.unrecorded.empty())
    throw CLI::RuntimeError(kDataLost);
}

void add_selection(CLI::App& command, RecorderOptions& recorder) {
  command.add_option("--topics", recorder.topics.allow, "only these, with wildcards: '/cosight/*/imu'");
  command.add_option("--exclude", recorder.topics.deny, "not these, with wildcards");
}

void add_file_options(CLI::App& command, RecordArguments& arguments) {
  command.add_option("--compression", arguments.compression, "zstd, lz4 or none")
      ->check(CLI::IsMember({"zstd", "lz4", "none"}))
      ->capture_default_str();
  command.add_option("--split-mb", arguments.split_mb, "go on in another file after so many [1e6 bytes]")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--split-seconds", arguments.split_seconds, "go on in another file after so long")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--ring", arguments.recorder.ring_seconds,
                  "keep the last SECONDS in memory; SIGUSR1 saves them to FILE_0001.mcap and so on")
      ->check(CLI::NonNegativeNumber);
  command.add_option("--duration", arguments.recorder.max_seconds, "end after so many seconds")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--attach", arguments.attachments, "put a file into the recording: configs, calibrations")
      ->check(CLI::ExistingFile);
  command.add_option("--schemas", arguments.schema_folders, "folder of .msg or .idl files of other types")
      ->check(CLI::ExistingDirectory);
}

}  // namespace

void add_record_command(CLI::App& program) {
  const auto arguments = std::make_shared<RecordArguments>();
  CLI::App* command =
      program.add_subcommand("record", "record the DDS domain into an MCAP file, until Ctrl-C");
  command->add_option("file", arguments->recorder.path, "recording to make: trial.mcap")->required();
  add_selection(*command, arguments->recorder);
  add_file_options(*command, *arguments);
  add_dds_options(*command, arguments->dds);
  command->add_option("--log-level", arguments->log_level, "trace, debug, info, warning, error or off")
      ->capture_default_str();
  command->footer("Example: cosight record trial.mcap --domain 7");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
