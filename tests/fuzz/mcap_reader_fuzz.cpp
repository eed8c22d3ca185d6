#include <cstddef>
#include <cstdint>
#include <memory>

#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/recording_error.hpp"
#include "shared/recording/recover.hpp"

namespace {

using namespace cosight::recording;  // NOLINT(google-build-using-namespace): one file

void read_everything(Bytes bytes) {
  constexpr std::uint64_t kLargestChunk = std::uint64_t{1} << 20;
  const McapReader reader(std::make_unique<MemorySource>(std::move(bytes)), {kLargestChunk});
  for (const auto order : {MessageOrder::kFile, MessageOrder::kLogTime}) {
    MessageCursor cursor = reader.messages({}, order);
    std::size_t touched = 0;
    while (const auto message = cursor.next()) {
      for (const std::uint8_t byte : message->payload)
        touched += byte;
    }
    static_cast<void>(touched);
  }
  MemorySink sink;
  recover(reader, sink, {.compression = Compression::kNone});
}

}  // namespace

/// Any bytes are read, or refused with a RecordingError.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    read_everything({data, data + size});
  } catch (const RecordingError&) {
    return 0;
  }
  return 0;
}
