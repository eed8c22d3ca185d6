#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "tools/aggregate_command.hpp"
#include "tools/compare_command.hpp"
#include "tools/evaluate_command.hpp"
#include "tools/export_command.hpp"
#include "tools/import_command.hpp"
#include "tools/info_command.hpp"
#include "tools/prepare_command.hpp"
#include "tools/record_command.hpp"
#include "tools/recover_command.hpp"
#include "tools/replay_command.hpp"
#include "tools/summarise_command.hpp"

namespace {

constexpr int kFailed = 1;
constexpr int kUsage = 2;

/// "cosight", or "cosight record" once that is known.
std::string command_of(const CLI::App& program) {
  std::string command = program.get_name();
  for (const CLI::App* given : program.get_subcommands())
    command += ' ' + given->get_name();
  return command;
}

int run(int argc, char** argv) {
  CLI::App program{"Cosight's tools around a run: prepare data, record, evaluate, summarise", "cosight"};
  program.require_subcommand(1);
  program.set_version_flag("--version", "cosight " COSIGHT_VERSION);
  program.footer(
      "Examples:\n"
      "  cosight record trial.mcap\n"
      "  cosight evaluate runs/robot/trajectory.tum runs/turn/truth/robot_cam0.tum --align se3\n"
      "  cosight evaluate --help\n");
  cosight::add_prepare_command(program);
  cosight::add_evaluate_command(program);
  cosight::add_summarise_command(program);
  cosight::add_aggregate_command(program);
  cosight::add_compare_command(program);
  cosight::add_record_command(program);
  cosight::add_replay_command(program);
  cosight::add_info_command(program);
  cosight::add_recover_command(program);
  cosight::add_import_command(program);
  cosight::add_export_command(program);
  try {
    program.parse(argc, argv);
  } catch (const CLI::RuntimeError& error) {
    return error.get_exit_code();  // a command's own
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    std::cerr << "cosight: " << error.what() << "; see " << command_of(program) << " --help\n";
    return kUsage;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "cosight: " << error.what() << '\n';
    return kFailed;
  }
}
