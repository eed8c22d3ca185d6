#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace cosight::recording {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

/// Where a recording goes: a file, or memory in a test.
class ByteSink {
 public:
  ByteSink() = default;
  ByteSink(const ByteSink&) = delete;
  ByteSink& operator=(const ByteSink&) = delete;
  virtual ~ByteSink() = default;

  /// All of it, or a RecordingError.
  virtual void write(ByteView bytes) = 0;
  /// Returns when what was written survives a power cut.
  virtual void sync() = 0;
};

class MemorySink : public ByteSink {
 public:
  void write(ByteView bytes) override { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
  void sync() override {}

  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace cosight::recording
