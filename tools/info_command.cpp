#include "tools/info_command.hpp"

#include <filesystem>
#include <iomanip>
#include <iostream>
#include <memory>

#include "shared/recording/mcap_reader.hpp"

namespace cosight {
namespace {

using recording::Channel;
using recording::McapContents;
using recording::McapReader;

void print_state(const McapContents& contents) {
  std::cout << "state:     " << (contents.is_complete ? "complete" : "cut off")
            << (contents.is_indexed ? ", indexed" : ", without a sound index: `cosight recover` makes one");
  if (contents.damaged > 0) std::cout << ", " << contents.damaged << " damaged parts left out";
  std::cout << '\n';
}

void print_channels(const McapReader& reader) {
  const McapContents& contents = reader.contents();
  const double duration = to_seconds(contents.end - contents.start);
  std::cout << "topics:\n";
  for (const auto& [id, channel] : contents.channels) {
    const auto count = contents.message_counts.find(id);
    const std::uint64_t messages = count == contents.message_counts.end() ? 0 : count->second;
    const recording::Schema* schema = reader.schema_of(channel);
    std::cout << "  " << std::left << std::setw(36) << channel.topic << std::right << std::setw(8) << messages
              << std::setw(9) << std::setprecision(1) << std::fixed
              << (duration > 0.0 ? static_cast<double>(messages) / duration : 0.0) << " Hz  "
              << (schema == nullptr ? "?" : schema->name)
              << (schema == nullptr || schema->encoding.empty() ? " (raw bytes)" : "") << '\n';
  }
}

void run(const std::filesystem::path& path) {
  const McapReader reader(path);
  const McapContents& contents = reader.contents();
  std::cout << "file:      " << path.string() << " (" << std::setprecision(1) << std::fixed
            << static_cast<double>(reader.source().size()) / 1e6 << " MB, profile \"" << contents.profile
            << "\", by \"" << contents.library << "\")\n";
  print_state(contents);
  std::cout << "duration:  " << std::setprecision(3) << to_seconds(contents.end - contents.start)
            << " s, from " << contents.start << " to " << contents.end
            << " ns\nmessages:  " << contents.messages << " in " << contents.segments.size() << " chunks\n";
  print_channels(reader);
  for (const auto& attachment : contents.attachments)
    std::cout << "attached:  " << attachment.name << " (" << attachment.bytes << " bytes)\n";
  for (const char* name : {"cosight.session", "cosight.losses"}) {
    const recording::Metadata* metadata = reader.metadata(name);
    if (metadata == nullptr) continue;
    std::cout << name << ":\n";
    for (const auto& [key, value] : metadata->entries)
      std::cout << "  " << key << ": " << value << '\n';
  }
}

}  // namespace

void add_info_command(CLI::App& program) {
  const auto path = std::make_shared<std::filesystem::path>();
  CLI::App* command = program.add_subcommand("info", "what is in a recording");
  command->add_option("file", *path, "MCAP file")->required()->check(CLI::ExistingFile);
  command->footer("Example: cosight info trial.mcap");
  command->callback([path] { run(*path); });
}

}  // namespace cosight
