#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "shared/recording/byte_sink.hpp"

namespace cosight::recording {

/// Where a recording comes from: a file, or memory in a test.
class ByteSource {
 public:
  ByteSource() = default;
  ByteSource(const ByteSource&) = delete;
  ByteSource& operator=(const ByteSource&) = delete;
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;
  /// As many bytes from `offset` on as there are, at most `into.size()`; fewer only at the end or where the
  /// medium can't be read.
  virtual std::size_t read(std::uint64_t offset, std::span<std::uint8_t> into) const = 0;
  /// For messages: the file's path.
  virtual std::string name() const = 0;
};

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(Bytes bytes) : bytes_(std::move(bytes)) {}

  std::uint64_t size() const override { return bytes_.size(); }
  std::size_t read(std::uint64_t offset, std::span<std::uint8_t> into) const override {
    if (offset >= bytes_.size()) return 0;
    const std::size_t count = std::min<std::size_t>(into.size(), bytes_.size() - offset);
    std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), count, into.begin());
    return count;
  }
  std::string name() const override { return "memory"; }

 private:
  Bytes bytes_;
};

}  // namespace cosight::recording
