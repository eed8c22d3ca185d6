#include "tools/export_command.hpp"

#include <filesystem>
#include <iostream>
#include <memory>

#include "shared/program/program.hpp"
#include "tools/recording_export.hpp"

namespace cosight {
namespace {

struct ExportArguments {
  std::filesystem::path file;
  std::filesystem::path euroc;
  std::filesystem::path tum;
  std::filesystem::path images;
};

void report(const std::filesystem::path& folder, const Exported& exported, std::uint64_t& unusable) {
  std::cout << folder.string() << ": " << exported.images << " images, " << exported.rows << " rows, "
            << exported.unusable << " messages could not be used\n";
  unusable += exported.unusable;
}

void run(const ExportArguments& arguments) {
  const recording::McapReader reader(arguments.file);
  std::uint64_t unusable = 0;
  if (!arguments.euroc.empty()) report(arguments.euroc, export_euroc(reader, arguments.euroc), unusable);
  if (!arguments.tum.empty()) report(arguments.tum, export_tum(reader, arguments.tum), unusable);
  if (!arguments.images.empty()) report(arguments.images, export_images(reader, arguments.images), unusable);
  if (unusable > 0) throw CLI::RuntimeError(static_cast<int>(ExitCode::kDataLost));
}

}  // namespace

void add_export_command(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand("export", "data out of a recording, for other programs");
  command->add_option("file", arguments->file, "MCAP file")->required()->check(CLI::ExistingFile);
  CLI::Option_group* forms = command->add_option_group("forms");
  forms->add_option("--euroc", arguments->euroc, "frames, IMU and calibration in EuRoC's folders");
  forms->add_option("--tum", arguments->tum, "trajectories in TUM's form");
  forms->add_option("--images", arguments->images, "the frames alone");
  forms->require_option(1, 0);
  command->footer("Example: cosight export trial.mcap --tum trajectories --images frames");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
