#include "shared/recording/dataset_recording.hpp"

#include <memory>
#include <optional>
#include <utility>

#include "shared/dataset/cosight_dataset.hpp"
#include "shared/recording/file_bytes.hpp"
#include "shared/recording/sample_recorder.hpp"

namespace cosight::recording {
namespace {

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
  bool record(SampleRecorder& recorder) {
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

}  // namespace

RecordedDataset record_dataset(const std::filesystem::path& folder, const std::filesystem::path& recording) {
  const CosightDataset dataset(folder);
  FileSink sink(recording);
  McapWriter writer(sink);
  SampleRecorder recorder(writer);
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
  return {writer.messages(), lost + robot.lost() + (wearer ? wearer->lost() : 0)};
}

}  // namespace cosight::recording
