#include <gmock/gmock.h>

#include <algorithm>
#include <string_view>

#include "shared/recording/crc32.hpp"
#include "shared/recording/recording_error.hpp"
#include "shared/recording/recover.hpp"
#include "tests/shared/recording/example_recording.hpp"

namespace cosight::recording {
namespace {

using testing::ElementsAre;

ByteView view(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(Crc, IsTheOneOfZipWhateverThePieces) {
  EXPECT_EQ(crc32(view("123456789")), 0xCBF43926U);  // the published check value
  const std::string_view text = "The quick brown fox jumps over the lazy dog";
  EXPECT_EQ(crc32(view(text)), 0x414FA339U);
  for (std::size_t cut = 0; cut <= text.size(); ++cut) {
    Crc32 crc;
    crc.add(view(text.substr(0, cut)));
    crc.add(view(text.substr(cut)));
    EXPECT_EQ(crc.value(), 0x414FA339U);
  }
}

class EveryCompression : public testing::TestWithParam<Compression> {
 protected:
  WriterOptions options() const { return {.compression = GetParam(), .chunk_bytes = 20'000}; }
};
INSTANTIATE_TEST_SUITE_P(Mcap, EveryCompression,
                         testing::Values(Compression::kNone, Compression::kZstd, Compression::kLz4));

TEST_P(EveryCompression, GivesBackWhatWasWritten) {
  const auto messages = example_messages(300, 1);
  const McapReader reader = reader_of(example_recording(messages, options()));
  EXPECT_TRUE(reader.contents().is_indexed);
  EXPECT_GT(reader.contents().segments.size(), 10U);
  EXPECT_EQ(messages_of(reader), messages);
  EXPECT_EQ(messages_of(reader, MessageOrder::kLogTime), messages);
}

TEST_P(EveryCompression, GivesBackWhatWasWrittenWithoutTheIndex) {
  const auto messages = example_messages(300, 2);
  Bytes bytes = example_recording(messages, options());
  bytes.resize(bytes.size() - 1);
  const McapReader reader = reader_of(bytes);
  EXPECT_FALSE(reader.contents().is_indexed);
  EXPECT_TRUE(reader.contents().is_complete);  // what is missing lies behind the messages
  EXPECT_EQ(reader.contents().damaged, 0U);
  EXPECT_EQ(messages_of(reader), messages);
}

TEST_P(EveryCompression, AnUnindexedFileSaysTheSameAsAnIndexedOne) {
  Bytes bytes = example_recording(example_messages(200, 3), options());
  const McapReader indexed = reader_of(bytes);
  bytes.pop_back();
  const McapReader scanned = reader_of(bytes);
  const McapContents& a = indexed.contents();
  const McapContents& b = scanned.contents();
  EXPECT_EQ(a.messages, b.messages);
  EXPECT_EQ(a.message_counts, b.message_counts);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.end, b.end);
  EXPECT_EQ(a.profile, b.profile);
  ASSERT_EQ(a.segments.size(), b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i) {
    EXPECT_EQ(a.segments[i].offset, b.segments[i].offset);
    EXPECT_EQ(a.segments[i].length, b.segments[i].length);
    EXPECT_EQ(a.segments[i].start, b.segments[i].start);
    EXPECT_EQ(a.segments[i].end, b.segments[i].end);
  }
  ASSERT_EQ(b.channels.size(), 3U);
  for (const auto& [id, channel] : a.channels) {
    EXPECT_EQ(channel.topic, b.channels.at(id).topic);
    EXPECT_EQ(channel.metadata, b.channels.at(id).metadata);
    EXPECT_EQ(indexed.schema_of(channel)->text, scanned.schema_of(b.channels.at(id))->text);
  }
  ASSERT_EQ(b.attachments.size(), 1U);
  EXPECT_EQ(a.attachments[0].offset, b.attachments[0].offset);
}

TEST(Mcap, KeepsAttachmentsAndMetadata) {
  const McapReader reader = reader_of(example_recording(example_messages(10, 4), {}));
  ASSERT_EQ(reader.contents().attachments.size(), 1U);
  const auto attachment = reader.attachment(reader.contents().attachments[0]);
  ASSERT_TRUE(attachment);
  EXPECT_EQ(attachment->name, "robot.yaml");
  EXPECT_EQ(attachment->media_type, "application/yaml");
  EXPECT_EQ(attachment->log_time, 5);
  EXPECT_EQ(attachment->create_time, 6);
  EXPECT_THAT(attachment->data, ElementsAre('a', ':', ' ', '1'));
  ASSERT_NE(reader.metadata("trial"), nullptr);
  EXPECT_EQ(reader.metadata("trial")->entries.at("place"), "corridor");
  EXPECT_EQ(reader.metadata("another"), nullptr);
}

TEST(Mcap, SelectsTopicsAndTimes) {
  const auto messages = example_messages(400, 5);
  const McapReader reader = reader_of(example_recording(messages, {.chunk_bytes = 10'000}));
  MessageFilter filter;
  filter.wants = [](const Channel& channel) { return channel.topic == "/imu"; };
  filter.start = messages[50].log_time;
  filter.end = messages[120].log_time;
  std::vector<OwnedMessage> expected;
  std::copy_if(messages.begin() + 50, messages.begin() + 121, std::back_inserter(expected),
               [](const OwnedMessage& m) { return m.topic == "/imu"; });
  EXPECT_EQ(messages_of(reader, MessageOrder::kLogTime, filter), expected);
}

TEST(Mcap, OrdersByLogTimeAcrossChunks) {
  auto messages = example_messages(300, 6);
  for (std::size_t i = 0; i + 40 < messages.size(); i += 40) {
    std::swap(messages[i], messages[i + 39]);  // further apart than a chunk is long
  }
  const McapReader reader = reader_of(example_recording(messages, {.chunk_bytes = 8'000}));
  EXPECT_EQ(messages_of(reader, MessageOrder::kFile), messages);
  std::stable_sort(messages.begin(), messages.end(),
                   [](const auto& a, const auto& b) { return a.log_time < b.log_time; });
  EXPECT_EQ(messages_of(reader, MessageOrder::kLogTime), messages);
}

TEST(Mcap, AnEmptyRecordingIsARecording) {
  const McapReader reader = reader_of(example_recording({}, {}));
  EXPECT_TRUE(reader.contents().is_indexed);
  EXPECT_EQ(reader.contents().messages, 0U);
  EXPECT_TRUE(messages_of(reader).empty());
}

TEST(Mcap, AForeignFileIsRefused) {
  EXPECT_THROW(reader_of({'P', 'K', 3, 4}), RecordingError);
}

TEST(Mcap, WhatIsFlushedCanBeReadBeforeTheEndIsWritten) {
  const auto messages = example_messages(20, 7);
  int count = 0;
  example_recording(messages, {}, [&](McapWriter& writer, const Bytes& so_far) {
    writer.flush();
    ++count;
    EXPECT_EQ(messages_of(reader_of(so_far)).size(), static_cast<std::size_t>(count));
  });
}

TEST_P(EveryCompression, RecoveringGivesAWholeFileWithTheSameMessages) {
  const auto messages = example_messages(300, 8);
  Bytes bytes = example_recording(messages, options());
  bytes.resize(bytes.size() * 2 / 3);
  const McapReader cut = reader_of(bytes);
  MemorySink sink;
  const Recovered recovered = recover(cut, sink, options());
  const McapReader whole = reader_of(sink.bytes());
  EXPECT_TRUE(whole.contents().is_indexed);
  EXPECT_EQ(recovered.messages, cut.contents().messages);
  EXPECT_EQ(messages_of(whole), messages_of(cut));
  EXPECT_GT(recovered.messages, 150U);
  ASSERT_EQ(whole.contents().attachments.size(), 1U);
  EXPECT_TRUE(whole.attachment(whole.contents().attachments[0]));
  EXPECT_NE(whole.metadata("trial"), nullptr);
}

}  // namespace
}  // namespace cosight::recording
