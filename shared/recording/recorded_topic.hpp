#pragma once

#include "shared/recording/mcap_records.hpp"
#include "shared/recording/message_schemas.hpp"
#include "shared/transport/blind_topic.hpp"

namespace cosight::recording {

/// A DDS topic as a recording describes it.
struct RecordedTopic {
  Schema schema;    ///< id not yet given
  Channel channel;  ///< ids not yet given
};

/// With ROS 2's names, its quality of service as rosbag2 writes it, and what a replay needs besides.
RecordedTopic describe(const transport::BlindTopic& topic, const MessageSchemas& schemas);

/// The DDS topic that a channel was recorded from; of a recording by somebody else, as ROS 2 would name it.
/// `schema`: may be null.
transport::BlindTopic blind_topic(const Channel& channel, const Schema* schema);

/// Says something once for all who come later, as a calibration does. All of Cosight's writers are transient
/// local, so for its own topics the table decides.
bool is_latched(const transport::BlindTopic& topic);

}  // namespace cosight::recording
