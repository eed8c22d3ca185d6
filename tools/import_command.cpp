#include "tools/import_command.hpp"

#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>

#include "shared/dataset/cosight_dataset.hpp"
#include "shared/program/program.hpp"
#include "shared/recording/file_bytes.hpp"
#include "shared/recording/sample_recorder.hpp"

namespace cosight {
namespace {

struct ImportArguments {
  std::filesystem::path dataset;
  std::filesystem::path recording;
};

/// One agent's samples, the next one looked at before it is taken.
class Stream {
 public:
  Stream(Agent agent, std::unique_ptr<SampleSource> source) : agent_(agent), source_(std::move(source)) {
    next_ = source_->next();
  }

  const std::optional<Sample>& next() const { return next_; }
  bool is_before(const Stream& other) const {
    if (!next_ || !other.next_) return next_.has_value();
    return stamp_of(*next_) <= stamp_of(*other.next_);
  }
  bool record(recording::SampleRecorder& recorder) {
    const bool taken = recorder.write(agent_, *next_);
    next_ = source_->next();
    return taken;
  }
  std::uint64_t lost() const { return source_->counters().lost(); }

 private:
  Agent agent_;
  std::unique_ptr<SampleSource> source_;
  std::optional<Sample> next_;
};

void run(const ImportArguments& arguments) {
  const CosightDataset dataset(arguments.dataset);
  recording::FileSink sink(arguments.recording);
  recording::McapWriter writer(sink);
  recording::SampleRecorder recorder(writer);
  Stream robot(Agent::kRobot, dataset.open_robot());
  std::optional<Stream> wearer;
  if (robot.next()) recorder.write(Agent::kRobot, dataset.robot_camera(), stamp_of(*robot.next()));
  if (dataset.has_wearer()) {
    wearer.emplace(Agent::kWearer, dataset.open_wearer());
    if (wearer->next()) recorder.write(Agent::kWearer, dataset.wearer_camera(), stamp_of(*wearer->next()));
  }
  std::uint64_t lost = 0;
  while (robot.next() || (wearer && wearer->next())) {
    Stream& first = wearer && !robot.is_before(*wearer) ? *wearer : robot;
    if (!first.record(recorder)) ++lost;
  }
  writer.close();
  lost += robot.lost() + (wearer ? wearer->lost() : 0);
  std::cout << arguments.recording.string() << ": " << writer.messages() << " messages, " << lost
            << " samples could not be used\n";
  if (lost > 0) throw CLI::RuntimeError(static_cast<int>(ExitCode::kDataLost));
}

}  // namespace

void add_import_command(CLI::App& program) {
  const auto arguments = std::make_shared<ImportArguments>();
  CLI::App* command = program.add_subcommand("import", "make a recording of a Cosight dataset folder");
  command->add_option("dataset", arguments->dataset, "folder, as sim and prepare write it")
      ->required()
      ->check(CLI::ExistingDirectory);
  command->add_option("file", arguments->recording, "MCAP file to make")->required();
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cosight
