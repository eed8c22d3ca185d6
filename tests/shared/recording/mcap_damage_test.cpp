#include <gmock/gmock.h>

#include <random>

#include "shared/recording/recover.hpp"
#include "tests/shared/recording/example_recording.hpp"

namespace cosight::recording {
namespace {

/// After which byte of the file how many messages have been promised: their chunk is whole.
struct Promise {
  std::size_t bytes = 0;
  std::size_t messages = 0;
};

struct PromisedRecording {
  Bytes bytes;
  std::vector<Promise> promises;
};

PromisedRecording promised_recording(const std::vector<OwnedMessage>& messages,
                                     const WriterOptions& options) {
  PromisedRecording result;
  std::size_t last_size = 0;
  std::size_t count = 0;
  result.bytes = example_recording(messages, options, [&](McapWriter& writer, const Bytes& so_far) {
    ++count;
    if (writer.bytes_waiting() == 0 && so_far.size() > last_size) {
      last_size = so_far.size();
      result.promises.push_back({so_far.size(), count});
    }
  });
  return result;
}

class Truncated : public testing::TestWithParam<Compression> {};
INSTANTIATE_TEST_SUITE_P(Mcap, Truncated,
                         testing::Values(Compression::kNone, Compression::kZstd, Compression::kLz4));

TEST_P(Truncated, AtAnyByteKeepsEveryCompleteChunk) {
  const auto messages = example_messages(60, 11);
  const auto recording = promised_recording(messages, {.compression = GetParam(), .chunk_bytes = 8'000});
  ASSERT_GT(recording.promises.size(), 5U);
  for (std::size_t size = 0; size < recording.bytes.size(); size += 53) {
    const Bytes cut(recording.bytes.begin(), recording.bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const auto found = messages_of(reader_of(cut));
    std::size_t promised = 0;
    for (const Promise& promise : recording.promises) {
      if (promise.bytes <= size) promised = promise.messages;
    }
    ASSERT_GE(found.size(), promised) << "cut at " << size;
    ASSERT_TRUE(std::equal(found.begin(), found.end(), messages.begin())) << "cut at " << size;
  }
}

TEST(Damaged, AnUncompressedChunkThatIsCutOffGivesItsWholeMessages) {
  const auto messages = example_messages(40, 12);
  const Bytes whole =
      example_recording(messages, {.compression = Compression::kNone, .chunk_bytes = 1 << 20});
  std::size_t last = 0;
  for (std::size_t size = 500; size < whole.size() * 2 / 3; size += 501) {
    const auto found =
        messages_of(reader_of({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}));
    ASSERT_GE(found.size(), last);
    ASSERT_TRUE(std::equal(found.begin(), found.end(), messages.begin()));
    last = found.size();
  }
  EXPECT_GT(last, messages.size() / 2);
}

TEST(Damaged, AFlippedBitCostsNoMoreThanItsChunk) {
  const auto messages = example_messages(200, 13);
  const Bytes whole = example_recording(messages, {.compression = Compression::kNone, .chunk_bytes = 10'000});
  const McapReader intact = reader_of(whole);
  const Segment& third = intact.contents().segments.at(2);
  Bytes bytes = whole;
  bytes[third.offset + third.length / 2] ^= 0x10;
  const McapReader reader = reader_of(bytes);
  auto cursor = reader.messages({}, MessageOrder::kFile);
  std::size_t found = 0;
  while (cursor.next())
    ++found;
  EXPECT_EQ(cursor.damaged(), 1U);
  EXPECT_LT(found, messages.size());
  EXPECT_GT(found, messages.size() - 20);
  MemorySink sink;
  EXPECT_EQ(recover(reader, sink).messages, found);
}

TEST(Damaged, AChunkThatClaimsToBeHugeCostsNoMemory) {
  Bytes bytes = example_recording(example_messages(5, 14), {});
  const Segment chunk = reader_of(bytes).contents().segments.at(0);
  const std::size_t size_at = chunk.offset + kRecordHeadBytes + 16;
  bytes[size_at + 3] = 0x0F;  // 250 MiB, within what is allowed
  EXPECT_TRUE(messages_of(reader_of(bytes)).empty());
  bytes[size_at + 7] = 0x7F;
  EXPECT_TRUE(messages_of(reader_of(bytes)).empty());
}

TEST(Damaged, AnyBytesAreReadWithoutHarm) {
  const Bytes whole = example_recording(example_messages(60, 15), {.chunk_bytes = 8'000});
  std::mt19937 random(16);
  for (int trial = 0; trial < 2'000; ++trial) {
    Bytes bytes = whole;
    for (int flips = 0; flips < 8; ++flips)
      bytes[8 + random() % (bytes.size() - 8)] = static_cast<std::uint8_t>(random());
    const McapReader reader = reader_of(bytes, {.max_chunk_bytes = 1 << 20});
    EXPECT_LE(messages_of(reader).size(), 200U);
    for (const AttachmentEntry& entry : reader.contents().attachments)
      reader.attachment(entry);
  }
}

}  // namespace
}  // namespace cosight::recording
