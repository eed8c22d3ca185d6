#include "tools/recover_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include "shared/recording/file_bytes.hpp"
#include "shared/recording/recover.hpp"

namespace cosight {
namespace {

struct RecoverArguments {
  std::filesystem::path from;
  std::filesystem::path to;
};

void run(const RecoverArguments& arguments) {
  const recording::McapReader reader(arguments.from);
  recording::FileSink sink(arguments.to);
  const recording::Recovered recovered = recording::recover(reader, sink);
  std::cout << arguments.to.string() << ": " << recovered.messages << " messages, " << recovered.attachments
            << " attachments; " << recovered.damaged << " damaged parts left out\n";
}

}  // namespace

void add_recover_command(CLI::App& program) {
  const auto arguments = std::make_shared<RecoverArguments>();
  CLI::App* command =
      program.add_subcommand("recover", "make a cut-off or damaged recording whole for everyone's tools");
  command->add_option("file", arguments->from, "MCAP file")->required()->check(CLI::ExistingFile);
  command->add_option("out", arguments->to, "MCAP file to make")->required();
  command->footer("Example: cosight recover cut_off.mcap whole.mcap");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
