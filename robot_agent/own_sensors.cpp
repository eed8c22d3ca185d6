#include "robot_agent/own_sensors.hpp"

#include "robot_agent/outbox/publisher.hpp"
#include "shared/transport/robot_topic_source.hpp"

namespace cosight::robot {

OwnSensors::OwnSensors(const AgentInput& input, const RobotOptions& options,
                       const transport::Participant& participant, Intake& intake, inbox::Inbox& inbox,
                       const std::atomic<bool>& stop)
    : camera_(input.camera),
      as_fast_as_possible_(!input.live && options.replay.rate <= 0.0),
      intake_(intake),
      inbox_(inbox),
      stop_(stop) {
  if (options.input.topics) {
    source_ = std::make_unique<transport::RobotTopicSource>(participant, options.input.end_after, stop);
    return;
  }
  source_ =
      input.live ? input.open() : std::make_unique<PacedReplay>(input.open, options.replay, clock_, stop);
  const bool tells_poses = input.has_wearer_pose && intake.takes_tracked_poses();
  publisher_.emplace(participant, options.input.output.encoding, tells_poses);
}

OwnSensors::~OwnSensors() {
  if (thread_.joinable()) thread_.join();
}

void OwnSensors::start() {
  thread_ = std::thread([this] { play(); });
}

void OwnSensors::play() {
  bool is_first = true;
  while (auto sample = source_->next()) {
    if (publisher_ && is_first) publisher_->publish(camera_, stamp_of(*sample));
    is_first = false;
    if (publisher_) publisher_->publish(*sample);
    // As a recording of the topics would give it back, to the last bit.
    intake_.push(publisher_ ? transport::as_received(std::move(*sample)) : std::move(*sample));
    constexpr Stamp kSlice = kNanosecondsPerSecond / 10;
    while (as_fast_as_possible_ && !stop_ && !inbox_.wait_for_room(kSlice)) {
    }
  }
  intake_.close();
}

void OwnSensors::report(outbox::YamlText& text) const {
  const SourceCounters counters = source_->counters();
  text.section("own_sensors")
      .value("delivered", counters.delivered)
      .value("unreadable", counters.unreadable)
      .value("wrong_size", counters.wrong_size)
      .value("not_finite", counters.not_finite)
      .value("stamp_went_back", counters.stamp_went_back)
      .value("gaps", counters.gaps);
  if (!publisher_) return;
  for (const auto& [section, sent] : publisher_->counters())
    outbox::report(text, section, sent);
}

}  // namespace cosight::robot
