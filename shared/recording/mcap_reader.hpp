#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "shared/recording/byte_source.hpp"
#include "shared/recording/mcap_contents.hpp"
#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

enum class MessageOrder {
  kFile,     ///< as they were written
  kLogTime,  ///< by reception; as they were written where it is the same
};

/// Which messages are wanted. Chunks that hold none of them are not read when the file has an index.
struct MessageFilter {
  std::function<bool(const Channel&)> wants;  ///< empty: every channel
  Stamp start = 0;                            ///< log time, inclusive
  Stamp end = std::numeric_limits<Stamp>::max();
};

/// Goes through the messages once. Its reader has to outlive it.
class MessageCursor {
 public:
  MessageCursor(const ByteSource& source, const McapContents& contents, const ReaderLimits& limits,
                const MessageFilter& filter, MessageOrder order);
  ~MessageCursor();
  MessageCursor(MessageCursor&& other) noexcept;
  MessageCursor& operator=(MessageCursor&& other) = delete;

  /// Nothing at the end. The payload lies in memory of the cursor until the next call.
  std::optional<Message> next();

  /// Chunks that could not be read although the file's index names them.
  std::uint64_t damaged() const { return damaged_; }

 private:
  struct Loaded;
  void load(std::size_t segment);
  void load_what_is_due();

  const ByteSource& source_;
  ReaderLimits limits_;
  Stamp start_, end_;
  MessageOrder order_;
  std::vector<bool> wanted_;              ///< by channel id
  std::vector<const Segment*> segments_;  ///< in the order in which they are needed
  std::size_t next_segment_ = 0;
  std::vector<std::unique_ptr<Loaded>> loaded_;
  Loaded* current_ = nullptr;  ///< that the last message came from
  std::uint64_t damaged_ = 0;
};

/// Reads any MCAP file: indexed or not, chunked or not, zstd or lz4, cut off at any byte. Opening goes
/// through the whole file when there is no index.
class McapReader {
 public:
  /// Throws RecordingError when the source is no MCAP file.
  explicit McapReader(std::unique_ptr<ByteSource> source, const ReaderLimits& limits = {});
  explicit McapReader(const std::filesystem::path& path);

  const McapContents& contents() const { return contents_; }
  const ByteSource& source() const { return *source_; }

  MessageCursor messages(const MessageFilter& filter = {}, MessageOrder order = MessageOrder::kLogTime) const;

  /// Nothing when it is damaged.
  std::optional<Attachment> attachment(const AttachmentEntry& entry) const;

  /// The last metadata record of that name: what a recorder knew in the end. Null: none.
  const Metadata* metadata(std::string_view name) const;

  /// Null: a channel without one, or a damaged file.
  const Schema* schema_of(const Channel& channel) const;

 private:
  std::unique_ptr<ByteSource> source_;
  ReaderLimits limits_;
  McapContents contents_;
};

}  // namespace cosight::recording
