#pragma once

#include <memory>
#include <optional>
#include <string_view>

#include "shared/recording/byte_sink.hpp"

namespace cosight::recording {

enum class Compression { kNone, kZstd, kLz4 };

/// As MCAP writes it: "", "zstd" or "lz4".
std::string_view name_of(Compression compression);
std::optional<Compression> compression_named(std::string_view name);

/// Compresses one chunk after the other; keeps its working memory.
class Compressor {
 public:
  /// `level`: of zstd [1, 19], higher is smaller and slower; lz4 has but one here.
  Compressor(Compression compression, int level);
  ~Compressor();
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;

  /// Overwrites `out`. False when it would not get smaller by a fiftieth (a JPEG): better stored as it is.
  bool compress(ByteView bytes, Bytes& out);

 private:
  struct Context;
  Compression compression_;
  std::unique_ptr<Context> context_;
};

/// Exactly `size` bytes into `out`, or false: damaged, or of another size. Memory is taken only as data
/// comes, so that a lie about the size costs nothing.
bool decompress(Compression compression, ByteView bytes, std::uint64_t size, Bytes& out);

}  // namespace cosight::recording
