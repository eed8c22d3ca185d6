#include "robot_agent/robot_agent.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <iterator>

#include "robot_agent/locator_plan.hpp"
#include "robot_agent/vins_plan.hpp"
#include "shared/transport/robot_topic_source.hpp"

namespace cosight::robot {
namespace {

using std::chrono::milliseconds;

/// With the camera that its topic tells, when no file does.
AgentInput with_received_camera(AgentInput input, const RobotOptions& options,
                                const transport::Participant& participant, const std::atomic<bool>& stop) {
  if (input.knows_camera) return input;
  const std::string topic(transport::topics::kRobotCameraInfo.profile.name);
  spdlog::info("waiting up to {:g} s for {} on domain {}", options.wait_for_sensors, topic,
               options.dds.domain);
  const auto camera = transport::receive_robot_camera(
      participant, milliseconds(static_cast<std::int64_t>(1e3 * options.wait_for_sensors)), stop);
  if (!camera) {
    throw transport::TransportError("nobody told the robot's camera on " + topic + " of domain " +
                                    std::to_string(options.dds.domain) +
                                    "; start what publishes its sensors, or give --calibration");
  }
  input.camera = *camera;
  input.knows_camera = true;
  return input;
}

Stamp steady_now() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

}  // namespace

RobotAgent::RobotAgent(const RobotOptions& options, const outbox::RunDescription& description,
                       const std::atomic<bool>& stop)
    : options_(options),
      stop_(stop),
      participant_(options.dds),
      input_(with_received_camera(prepare_input(options.input, Agent::kRobot, stop), options, participant_,
                                  stop)),
      inbox_(inbox::with_camera(options.inbox, input_.camera)),
      intake_(inbox_, participant_, plan_locator(options, input_)),
      vins_plan_(plan_vins(options, input_)),
      record_(outbox::RunFolder(options.run_dir), description),
      publisher_(participant_),
      presence_(participant_, transport::topics::kRobotHeartbeat, options.agent_id),
      sensors_(input_, options, participant_, intake_, inbox_, stop) {
  if (has_slam(options.estimators)) {
    slam_.emplace(input_.camera, options.slam, input_.known_points, steady_now);
    wearer_.emplace(participant_, inbox_, intake_, !input_.has_wearer_pose && intake_.takes_tracked_poses());
  }
  if (vins_plan_) {
    vins_.emplace(*vins_plan_, input_.camera, *input_.T_BS, record_.folder(), &participant_,
                  options.vins_help);
    intake_.feed(*vins_, options.estimators);
  }
  spdlog::info("robot '{}' on domain {}: {}", options.agent_id, options.dds.domain, sensors_.description());
}

std::vector<std::string> RobotAgent::run(const Progress& progress) {
  wait_for_wearer();
  started_ = clock_.now();
  sensors_.start();
  while (!inbox_.finished()) {
    constexpr Stamp kPatience = kNanosecondsPerSecond / 10;
    if (auto bundle = inbox_.pop(kPatience)) process(*bundle, progress);
    if (!slam_ && progress) progress(vins_->status());
  }
  if (vins_) vins_->finish();
  return finish();
}

void RobotAgent::wait_for_wearer() {
  const bool needs_no_wearer =
      !wearer_ || (options_.slam.mode == slam::Mode::kMono && !input_.known_points.empty());
  if (needs_no_wearer || options_.wait_for_wearer <= 0.0) return;
  spdlog::info("waiting up to {:g} s for a wearer on domain {}", options_.wait_for_wearer,
               options_.dds.domain);
  const milliseconds patience(static_cast<std::int64_t>(1e3 * options_.wait_for_wearer));
  if (wearer_->wait_for_wearer(patience, stop_)) return;
  spdlog::warn(
      "no wearer came on domain {}; going on without one (start wearable_agent, or give both the same "
      "--domain)",
      options_.dds.domain);
}

void RobotAgent::process(FrameBundle& bundle, const Progress& progress) {
  if (vins_) vins_->guide(bundle);
  const FrameEstimate estimate = slam_->process(bundle);
  if (vins_) vins_->push(bundle, estimate);
  intake_.robot_is_at(estimate);
  record_.add(bundle, estimate);
  publisher_.publish(estimate, [this] { return slam_->map(); });
  const outbox::LinkState link{.lost = wearer_->frames_lost() + inbox_.counters().robot_lost,
                               .worn_behind = inbox_.worn_behind(),
                               .wearer_offset = inbox_.stamps().wearer_offset()};
  const auto line = status_.update(bundle, estimate, link, clock_.now());
  if (line && progress) progress(vins_ ? *line + "  " + vins_->status() : *line);
}

std::vector<std::string> RobotAgent::finish() {
  constexpr milliseconds kPatience{500};
  publisher_.finish(kPatience);
  const inbox::InboxCounters counted = inbox_.counters();
  auto problems = record_.finish(slam_ ? slam_->map() : std::vector<MapPoint>{},
                                 to_seconds(clock_.now() - started_), [&](outbox::YamlText& text) {
                                   if (slam_)
                                     text.section("inbox").counts(inbox::named_counts(counted)).top();
                                   sensors_.report(text);
                                   if (wearer_) wearer_->report(text);
                                   intake_.report(text);
                                   if (slam_) publisher_.report(text);
                                   if (vins_) vins_->report(text);
                                 });
  if (const auto lost = sensors_.counters().lost(); lost > 0) {
    problems.push_back(
        std::to_string(lost) +
        " samples of the robot's own input could not be used; see own_sensors in summary.yaml");
  }
  std::ranges::move(inbox::lost_robot_images(counted), std::back_inserter(problems));
  if (vins_) std::ranges::move(vins_->problems(), std::back_inserter(problems));
  return problems;
}

}  // namespace cosight::robot
