#include "tools/import_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include "shared/program/program.hpp"
#include "shared/recording/dataset_recording.hpp"

namespace cosight {
namespace {

struct ImportArguments {
  std::filesystem::path dataset;
  std::filesystem::path recording;
};

void run(const ImportArguments& arguments) {
  const auto recorded = recording::record_dataset(arguments.dataset, arguments.recording);
  std::cout << arguments.recording.string() << ": " << recorded.messages << " messages, " << recorded.lost
            << " samples could not be used\n";
  if (recorded.lost > 0) throw CLI::RuntimeError(static_cast<int>(ExitCode::kDataLost));
}

}  // namespace

void add_import_command(CLI::App& program) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = program.add_subcommand("import", "make a recording of a Cosight dataset folder");
  command->add_option("dataset", arguments->dataset, "folder, as sim and prepare write it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("file", arguments->recording, "MCAP file to make")->required();
  command->footer("Example: cosight import runs/turn trial.mcap");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
