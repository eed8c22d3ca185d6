#pragma once

#include <cstdint>
#include <initializer_list>
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

  /// All the parts one after the other, or a RecordingError and nothing of them.
  virtual void write(std::initializer_list<ByteView> parts) = 0;
  /// Returns when what was written survives a power cut.
  virtual void sync() = 0;
};

class MemorySink : public ByteSink {
 public:
  void write(std::initializer_list<ByteView> parts) override {
    for (const ByteView part : parts)
      bytes_.insert(bytes_.end(), part.begin(), part.end());
  }
  void sync() override {}

  const Bytes& bytes() const { return bytes_; }

 private:
  Bytes bytes_;
};

}  // namespace cosight::recording
