#include "robot_agent/offline_run.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

#include "robot_agent/locator_plan.hpp"
#include "robot_agent/vins_plan.hpp"
#include "shared/recording/recording_error.hpp"

namespace cosight::robot {
namespace {

/// With the camera that the recording tells, when no file does.
AgentInput with_recorded_camera(AgentInput input, const recording::McapReader& reader) {
  if (input.knows_camera) return input;
  const auto camera = recording::recorded_robot_camera(reader);
  if (!camera) {
    throw recording::RecordingError("recording " + reader.source().name() +
                                    " does not tell the robot's camera; give --calibration");
  }
  input.camera = *camera;
  input.knows_camera = true;
  return input;
}

}  // namespace

OfflineRun::OfflineRun(const RobotOptions& options, const outbox::RunDescription& description,
                       const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      reader_(options.input.recording),
      source_(reader_),
      input_(with_recorded_camera(prepare_input(options.input, Agent::kRobot, stop), reader_)),
      inbox_(inbox::with_camera(options.inbox, input_.camera), [this] { return arrival_; }),
      intake_(inbox_, plan_locator(options, input_)),
      vins_plan_(plan_vins(options, input_)),
      record_(outbox::RunFolder(options.run_dir), description) {
  if (has_slam(options.estimators)) slam_.emplace(input_.camera, options.slam, input_.known_points);
  if (vins_plan_) {
    vins_.emplace(*vins_plan_, input_.camera, *input_.T_BS, record_.folder(), nullptr, options.vins_help);
    intake_.feed(*vins_, options.estimators);
  }
}

std::vector<std::string> OfflineRun::run(const Progress& progress) {
  began_ = clock_.now();
  while (auto event = source_.next()) {
    pace(event->log_time);
    if (stop_) break;
    arrival_ = std::max(arrival_, event->log_time);
    push(std::move(*event));
    process_ready(progress);
    if (!slam_ && progress) progress(vins_->status());
  }
  intake_.close();
  while (!inbox_.finished()) {
    arrival_ += options_.inbox.pairing.max_wait;  // nothing more comes: what waits has waited long enough
    process_ready(progress);
  }
  if (vins_) vins_->finish();
  return finish();
}

void OfflineRun::pace(Stamp log_time) {
  if (options_.replay.rate <= 0.0) return;
  const double offset = static_cast<double>(log_time - reader_.contents().start) / options_.replay.rate;
  clock_.sleep_until(began_ + static_cast<Stamp>(offset), stop_);
}

void OfflineRun::push(recording::RecordedEvent&& event) {
  constexpr inbox::PeerId kWearer{1};  // one session: a recording does not tell its writers apart
  const bool is_wearers = event.from == Agent::kWearer;
  if (auto* const sample = std::get_if<Sample>(&event.content)) {
    if (!is_wearers) {
      intake_.push(std::move(*sample));
    } else if (auto* const frame = std::get_if<ImageSample>(sample)) {
      inbox_.push_wearer_frame(std::move(*frame), kWearer);
    } else if (const auto* const ahrs = std::get_if<AhrsSample>(sample)) {
      intake_.push_ahrs(*ahrs, kWearer);
    }
  } else if (const auto* const info = std::get_if<CameraInfoSample>(&event.content)) {
    if (is_wearers) inbox_.set_wearer_camera(info->camera);
  } else {
    inbox_.push_wearer_heartbeat(kWearer);
  }
}

void OfflineRun::process_ready(const Progress& progress) {
  while (auto bundle = inbox_.pop(0)) {
    bundle->decode_ms = 0.0;  // the only thing in it that another run would not repeat
    if (vins_) vins_->guide(*bundle);
    const FrameEstimate estimate = slam_->process(*bundle);
    if (vins_) vins_->push(*bundle, estimate);
    intake_.robot_is_at(estimate);
    record_.add(*bundle, estimate);
    const auto line = status_.update(*bundle, estimate, {.lost = inbox_.counters().robot_lost}, clock_.now());
    if (line && progress) progress(vins_ ? *line + "  " + vins_->status() : *line);
  }
}

std::vector<std::string> OfflineRun::finish() {
  const inbox::InboxCounters counted = inbox_.counters();
  const double run_seconds = to_seconds(clock_.now() - began_);
  const double recorded_seconds = to_seconds(reader_.contents().end - reader_.contents().start);
  auto problems = record_.finish(
      slam_ ? slam_->map() : std::vector<MapPoint>{}, run_seconds, [&](outbox::YamlText& text) {
        text.section("recording")
            .value("seconds", recorded_seconds)
            .value("speed_over_real_time", run_seconds > 0.0 ? recorded_seconds / run_seconds : 0.0)
            .value("delivered", source_.delivered())
            .value("unusable", source_.unusable())
            .value("damaged", reader_.contents().damaged);
        if (slam_) text.section("inbox").counts(inbox::named_counts(counted)).top();
        intake_.report(text);
        if (vins_) vins_->report(text);
      });
  if (const auto lost = source_.unusable() + reader_.contents().damaged; lost > 0)
    problems.push_back(std::to_string(lost) + " messages or chunks of the recording could not be used");
  std::ranges::move(inbox::lost_robot_images(counted), std::back_inserter(problems));
  if (vins_) std::ranges::move(vins_->problems(), std::back_inserter(problems));
  return problems;
}

}  // namespace cosight::robot
