// What scripts/experiments/recording measures of the files themselves:
//
//   recording_probe truncate FILE COUNT SEED
//     cuts it at COUNT random bytes; prints how often a whole chunk was missing
//   recording_probe write FILE MEGABYTES
//     writes frames of 345 kB without compression; prints MB/s, on the disk
//   recording_probe lost WITNESS {KILLED TIME_NS}...
//     recorders that were killed at those times, and one beside them that was not: prints for how long, at
//     most, a killed one's file holds nothing of what the other received before the kill [ms], and how many
//     files hold nothing at all

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <span>
#include <string>

#include "shared/recording/file_bytes.hpp"
#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/mcap_writer.hpp"

namespace {

using namespace cosight::recording;  // NOLINT(google-build-using-namespace): a program's own file

/// The beginning of a file.
class CutSource : public ByteSource {
 public:
  CutSource(const ByteSource& whole, std::uint64_t size) : whole_(whole), size_(size) {}

  std::uint64_t size() const override { return size_; }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> into) const override {
    if (offset >= size_) return 0;
    return whole_.read(offset, into.first(std::min<std::uint64_t>(into.size(), size_ - offset)));
  }
  std::string name() const override { return whole_.name(); }

 private:
  const ByteSource& whole_;
  std::uint64_t size_;
};

std::uint64_t messages_in(const McapReader& reader) {
  std::uint64_t messages = 0;
  MessageCursor cursor = reader.messages({}, MessageOrder::kFile);
  while (cursor.next())
    ++messages;
  return messages;
}

/// Messages of the chunks that end before `size`.
std::uint64_t promised(const McapReader& whole, std::uint64_t size) {
  McapContents contents = whole.contents();
  std::erase_if(contents.segments, [size](const Segment& s) { return s.offset + s.length > size; });
  MessageCursor cursor(whole.source(), contents, {}, {}, MessageOrder::kFile);
  std::uint64_t messages = 0;
  while (cursor.next())
    ++messages;
  return messages;
}

int truncate_at_random(const std::string& path, int count, unsigned seed) {
  const McapReader whole{std::filesystem::path(path)};
  std::mt19937_64 random(seed);
  int failures = 0;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t size = random() % whole.source().size();
    const McapReader cut(std::make_unique<CutSource>(whole.source(), size));
    if (messages_in(cut) < promised(whole, size)) ++failures;
  }
  std::cout << failures << '\n';
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

int write_frames(const std::string& path, double megabytes) {
  Bytes frame(345'600);
  std::mt19937 random(1);
  std::generate(frame.begin(), frame.end(), [&random] { return static_cast<std::uint8_t>(random()); });
  const auto count = static_cast<std::uint32_t>(megabytes * 1e6 / static_cast<double>(frame.size()));
  const auto began = std::chrono::steady_clock::now();
  FileSink sink(path);
  McapWriter writer(sink, {.compression = Compression::kNone});
  const ChannelId channel = writer.add_channel("/frames", "cdr", 0);
  for (std::uint32_t i = 0; i < count; ++i)
    writer.write(Message{channel, i, i, i, frame});
  writer.close();  // waits for the disk
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - began;
  std::cout << static_cast<double>(writer.bytes_written()) / 1e6 / elapsed.count() << '\n';
  return EXIT_SUCCESS;
}

struct LastMessage {
  std::uint32_t sequence = 0;
  cosight::Stamp log_time = 0;
};
using LastMessages = std::map<std::string, LastMessage>;

/// Of each topic, by the sequence numbers of its one writer.
LastMessages last_messages(const McapReader& reader) {
  LastMessages last;
  MessageCursor cursor = reader.messages({}, MessageOrder::kFile);
  while (const auto message = cursor.next()) {
    LastMessage& known = last[reader.contents().channels.at(message->channel_id).topic];
    if (message->sequence >= known.sequence) known = {message->sequence, message->log_time};
  }
  return last;
}

/// From the first message that a killed recorder should have to the kill [ns]. A topic's messages come in
/// their order: what is missing came after the last that is there, even if the other recorder had it long
/// before (the writers' history, which a recorder gets when it begins).
cosight::Stamp lost_before(cosight::Stamp kill, const LastMessages& last, const McapReader& witness) {
  MessageFilter filter;
  filter.wants = [&last](const Channel& channel) { return last.contains(channel.topic); };
  filter.start = kill - 10 * cosight::kNanosecondsPerSecond;
  filter.end = kill;
  cosight::Stamp lost = 0;
  MessageCursor cursor = witness.messages(filter, MessageOrder::kLogTime);
  while (const auto message = cursor.next()) {
    const LastMessage& known = last.at(witness.contents().channels.at(message->channel_id).topic);
    if (message->sequence > known.sequence)
      lost = std::max(lost, kill - std::max(message->log_time, known.log_time));
  }
  return lost;
}

int compare_with_witness(const std::string& path, std::span<char*> killed) {
  const McapReader witness{std::filesystem::path(path)};
  cosight::Stamp worst = 0;
  int empty = 0;
  for (std::size_t i = 0; i + 1 < killed.size(); i += 2) {
    const auto last = last_messages(McapReader{std::filesystem::path(killed[i])});
    if (last.empty()) ++empty;
    worst = std::max(worst, lost_before(std::atoll(killed[i + 1]), last, witness));
  }
  std::cout << worst / 1'000'000 << ' ' << empty << '\n';
  return EXIT_SUCCESS;
}

int run(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command == "truncate" && argc == 5)
    return truncate_at_random(argv[2], std::atoi(argv[3]), static_cast<unsigned>(std::atoi(argv[4])));
  if (command == "write" && argc == 4) return write_frames(argv[2], std::atof(argv[3]));
  if (command == "lost" && argc > 4)
    return compare_with_witness(argv[2], std::span(argv, static_cast<std::size_t>(argc)).subspan(3));
  std::cerr << "recording_probe: truncate FILE COUNT SEED, write FILE MEGABYTES or lost WITNESS {KILLED "
               "TIME_NS}...\n";
  return 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "recording_probe: " << error.what() << '\n';
    return EXIT_FAILURE;
  }
}
