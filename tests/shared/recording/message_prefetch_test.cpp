#include "shared/recording/message_prefetch.hpp"

#include <gtest/gtest.h>

#include "tests/shared/recording/example_recording.hpp"

namespace cosight::recording {
namespace {

class Prefetch : public testing::TestWithParam<std::size_t> {
 protected:
  std::vector<OwnedMessage> messages = example_messages(300, 1);
};
INSTANTIATE_TEST_SUITE_P(Room, Prefetch, testing::Values(0, 5'000, MessagePrefetch::kAhead));

TEST_P(Prefetch, GivesWhatTheCursorGives) {
  const McapReader reader = reader_of(example_recording(messages, {.chunk_bytes = 20'000}));
  MessagePrefetch ahead(reader.messages(), GetParam());
  for (const OwnedMessage& expected : messages) {
    const auto message = ahead.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->log_time, expected.log_time);
    EXPECT_EQ(message->publish_time, expected.publish_time);
    EXPECT_EQ(message->payload, expected.payload);
  }
  EXPECT_FALSE(ahead.next());
  EXPECT_EQ(ahead.damaged(), 0U);
}

TEST_P(Prefetch, CanBeLeftInTheMiddle) {
  const McapReader reader = reader_of(example_recording(messages, {.chunk_bytes = 20'000}));
  MessagePrefetch ahead(reader.messages(), GetParam());
  EXPECT_TRUE(ahead.next());
}

TEST(PrefetchOfADamagedFile, TellsWhatCouldNotBeRead) {
  Bytes bytes =
      example_recording(example_messages(300, 1), {.compression = Compression::kNone, .chunk_bytes = 20'000});
  bytes[bytes.size() / 2] ^= 0xFF;
  const McapReader reader = reader_of(std::move(bytes));
  ASSERT_TRUE(reader.contents().is_indexed);
  MessagePrefetch ahead(reader.messages());
  std::size_t read = 0;
  while (ahead.next())
    ++read;
  EXPECT_GT(read, 200U);
  EXPECT_LT(read, 300U);
  EXPECT_EQ(ahead.damaged(), 1U);
}

}  // namespace
}  // namespace cosight::recording
