#include "wearable_agent/wearable_agent.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "shared/program/process_usage.hpp"

namespace cosight::wearable {
namespace {

using std::chrono::milliseconds;

std::unique_ptr<SampleSource> open_source(const AgentInput& input, const ReplayOptions& replay,
                                          PacingClock& clock, const std::atomic<bool>& stop) {
  if (input.live) return input.open();
  return std::make_unique<PacedReplay>(input.open, replay, clock, stop);
}

}  // namespace

WearableAgent::WearableAgent(const WearableOptions& options, const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      input_(prepare_input(options.input, Agent::kWearer, stop)),
      source_(open_source(input_, options.replay, clock_, stop)),
      participant_(options.dds),
      presence_(participant_, transport::topics::kWearableHeartbeat, options.agent_id),
      publisher_(participant_, options.input.output.encoding) {
  spdlog::info("wearable '{}' on domain {}: {}", options.agent_id, options.dds.domain,
               source_->description());
}

RunReport WearableAgent::run(const Progress& progress) {
  listen_for_twin();
  wait_for_robot();
  started_ = clock_.now();
  cpu_at_start_ = process_usage().cpu_seconds;
  constexpr Stamp kProgressInterval = kNanosecondsPerSecond / 4;
  Stamp next_progress = started_;
  bool is_first = true;
  while (const auto sample = source_->next()) {
    if (is_first) publisher_.publish(input_.camera, stamp_of(*sample));
    is_first = false;
    publisher_.publish(*sample);
    refuse_to_be_second();
    if (clock_.now() < next_progress) continue;
    next_progress = clock_.now() + kProgressInterval;
    const RunReport so_far = report();
    presence_.update({so_far.sent.frames, so_far.sent.orientations, so_far.frames, so_far.orientations});
    if (progress) progress(so_far, publisher_.frame_readers());
  }
  const RunReport at_the_end = report();
  presence_.update(
      {at_the_end.sent.frames, at_the_end.sent.orientations, at_the_end.frames, at_the_end.orientations});
  constexpr milliseconds kPatience{2000};
  if (!stop_ && publisher_.frame_readers() > 0 && !publisher_.wait_until_delivered(kPatience)) {
    spdlog::warn("the last samples were not acknowledged within {} ms", kPatience.count());
  }
  return at_the_end;
}

void WearableAgent::listen_for_twin() const {
  const Stamp end = clock_.now() + from_seconds(options_.listen_for_twin);
  SteadyClock waiting;
  constexpr Stamp kSlice = kNanosecondsPerSecond / 50;
  while (clock_.now() < end && !stop_ && !presence_.has_older_namesake()) {
    waiting.sleep_until(std::min(end, clock_.now() + kSlice), stop_);
  }
  refuse_to_be_second();
}

void WearableAgent::wait_for_robot() const {
  if (options_.wait_for_robot <= 0.0) return;
  spdlog::info("waiting up to {:g} s for a robot on domain {}", options_.wait_for_robot, options_.dds.domain);
  const Stamp end = clock_.now() + from_seconds(options_.wait_for_robot);
  constexpr milliseconds kSlice{50};
  while (!publisher_.wait_for_robot(kSlice)) {
    if (stop_) return;
    refuse_to_be_second();
    if (clock_.now() > end) {
      throw transport::TransportError("no robot reads frames on domain " +
                                      std::to_string(options_.dds.domain) +
                                      "; start robot_agent, or give both the same --domain");
    }
  }
}

void WearableAgent::refuse_to_be_second() const {
  if (!presence_.has_older_namesake()) return;
  throw transport::TransportError("a wearable with the id '" + options_.agent_id +
                                  "' is already running on domain " + std::to_string(options_.dds.domain) +
                                  "; stop it, or give this one another agent_id or --domain");
}

RunReport WearableAgent::report() const {
  const ProcessUsage usage = process_usage();
  RunReport report;
  report.sent = publisher_.sent();
  report.frames = source_->counters(SampleKind::kImage);
  report.orientations = source_->counters(SampleKind::kAhrs);
  report.duration = to_seconds(clock_.now() - started_);
  report.cpu_seconds = usage.cpu_seconds - cpu_at_start_;
  report.peak_memory_mb = usage.peak_memory_mb;
  return report;
}

}  // namespace cosight::wearable
