#pragma once

#include <map>
#include <string_view>

#include "shared/dataset/agent_input.hpp"
#include "shared/recording/mcap_writer.hpp"
#include "shared/recording/message_schemas.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::recording {

/// Writes an agent's samples into a recording as if they had been said on their topics: for datasets and the
/// simulator, without DDS.
class SampleRecorder {
 public:
  /// `writer` has to outlive this.
  explicit SampleRecorder(McapWriter& writer) : writer_(writer) {}

  /// At its own stamp. False when the topic's message can't say it (a NaN).
  bool write(Agent agent, const Sample& sample);
  /// What the agent's camera is, before its first frame.
  bool write(Agent agent, const CameraModel& camera, Stamp stamp);

 private:
  template <class Kind>
  bool write_to(const transport::TopicProfile& profile, const Kind& sample);
  ChannelId channel_of(const transport::TopicProfile& profile);

  McapWriter& writer_;
  MessageSchemas schemas_ = MessageSchemas::built_in();
  struct Output {
    ChannelId channel = 0;
    std::uint32_t sequence = 0;
  };
  std::map<std::string_view, Output> outputs_;  ///< by topic
  Bytes payload_;
};

}  // namespace cosight::recording
