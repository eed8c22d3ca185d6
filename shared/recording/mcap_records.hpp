#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "shared/dataset/stamp.hpp"
#include "shared/recording/byte_sink.hpp"

namespace cosight::recording {

/// The records of MCAP (https://mcap.dev/spec), as far as anyone outside this room needs them. All times are
/// nanoseconds since the epoch of the recording machine.
using SchemaId = std::uint16_t;
using ChannelId = std::uint16_t;
using TextMap = std::map<std::string, std::string>;

/// How a channel's messages are to be read. Without an encoding only the type's name is known.
struct Schema {
  SchemaId id = 0;       ///< never 0
  std::string name;      ///< "sensor_msgs/msg/Imu"
  std::string encoding;  ///< "ros2msg", or empty
  std::string text;
};

struct Channel {
  ChannelId id = 0;
  SchemaId schema_id = 0;        ///< 0: none
  std::string topic;             ///< "/cosight/robot/imu"
  std::string message_encoding;  ///< "cdr"
  TextMap metadata;
};

struct Message {
  ChannelId channel_id = 0;
  std::uint32_t sequence = 0;
  Stamp log_time = 0;      ///< when it was received
  Stamp publish_time = 0;  ///< the writer's own stamp
  ByteView payload;        ///< somebody else's memory
};

struct Attachment {
  Stamp log_time = 0;
  Stamp create_time = 0;
  std::string name;
  std::string media_type;
  Bytes data;
};

struct Metadata {
  std::string name;
  TextMap entries;
};

/// One byte before each record, followed by its length in eight.
enum class Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr std::array<std::uint8_t, 8> kMagic = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
constexpr std::size_t kRecordHeadBytes = 9;          ///< opcode and length
constexpr std::size_t kMessageHeadBytes = 22;        ///< a message's content before its payload
constexpr std::size_t kFooterBytes = 9 + 8 + 8 + 4;  ///< with its head

}  // namespace cosight::recording
