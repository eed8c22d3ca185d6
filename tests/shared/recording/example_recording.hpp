#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/mcap_writer.hpp"

namespace cosight::recording {

/// A message that owns its payload, to be compared.
struct OwnedMessage {
  std::string topic;
  std::uint32_t sequence = 0;
  Stamp log_time = 0;
  Stamp publish_time = 0;
  Bytes payload;
  bool operator==(const OwnedMessage&) const = default;
};
void PrintTo(const OwnedMessage& message, std::ostream* out);  // NOLINT(readability-identifier-naming)

/// Messages of three topics: two interleaved, one with two messages only. Payloads of 0 to 3000 bytes, half
/// of them random, half easily compressed.
std::vector<OwnedMessage> example_messages(int count, unsigned seed);

/// A recording of them, with an attachment and metadata; `each` is called after each message.
Bytes example_recording(const std::vector<OwnedMessage>& messages, const WriterOptions& options,
                        const std::function<void(McapWriter&, const Bytes&)>& each = {});

McapReader reader_of(Bytes bytes, const ReaderLimits& limits = {});
std::vector<OwnedMessage> messages_of(const McapReader& reader, MessageOrder order = MessageOrder::kFile,
                                      const MessageFilter& filter = {});

}  // namespace cosight::recording
