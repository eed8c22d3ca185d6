#include "shared/recording/compression.hpp"

#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>

namespace cosight::recording {
namespace {

/// Feeds the compressed bytes to `step` until the output is whole. `step(in, out)` consumes from both and
/// returns false at an error; it is at its end when it takes and gives nothing more.
template <class Step>
bool pump(ByteView in, std::uint64_t size, Bytes& out, Step step) {
  constexpr std::size_t kFirst = std::size_t{256} << 10;
  std::size_t filled = 0;
  out.resize(std::min<std::uint64_t>(size, std::max(kFirst, in.size() * 4)));
  while (true) {
    std::span<std::uint8_t> room = std::span(out).subspan(filled);
    const std::size_t room_before = room.size();
    const std::size_t in_before = in.size();
    if (!step(in, room)) return false;
    filled += room_before - room.size();
    const bool stalled = room.size() == room_before && in.size() == in_before;
    if (filled == size && (in.empty() || stalled)) return in.empty();
    if (filled < out.size()) {
      if (stalled) return false;
    } else if (filled < size) {
      out.resize(std::min<std::uint64_t>(size, out.size() * 2));
    }
  }
}

bool decompress_zstd(ByteView bytes, std::uint64_t size, Bytes& out) {
  const std::unique_ptr<ZSTD_DStream, decltype(&ZSTD_freeDStream)> stream(ZSTD_createDStream(),
                                                                          ZSTD_freeDStream);
  if (!stream) return false;
  ZSTD_DCtx_setParameter(stream.get(), ZSTD_d_windowLogMax, 27);  // 128 MiB: a frame asks for what it likes
  return pump(bytes, size, out, [&stream](ByteView& in, std::span<std::uint8_t>& room) {
    ZSTD_inBuffer source{in.data(), in.size(), 0};
    ZSTD_outBuffer target{room.data(), room.size(), 0};
    const std::size_t result = ZSTD_decompressStream(stream.get(), &target, &source);
    in = in.subspan(source.pos);
    room = room.subspan(target.pos);
    return ZSTD_isError(result) == 0;
  });
}

bool decompress_lz4(ByteView bytes, std::uint64_t size, Bytes& out) {
  LZ4F_dctx* raw = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&raw, LZ4F_VERSION)) != 0) return false;
  const std::unique_ptr<LZ4F_dctx, decltype(&LZ4F_freeDecompressionContext)> context(
      raw, LZ4F_freeDecompressionContext);
  return pump(bytes, size, out, [&context](ByteView& in, std::span<std::uint8_t>& room) {
    std::size_t taken = in.size();
    std::size_t given = room.size();
    const std::size_t result =
        LZ4F_decompress(context.get(), room.data(), &given, in.data(), &taken, nullptr);
    in = in.subspan(taken);
    room = room.subspan(given);
    return LZ4F_isError(result) == 0;
  });
}

}  // namespace

std::string_view name_of(Compression compression) {
  switch (compression) {
    case Compression::kNone:
      return "";
    case Compression::kZstd:
      return "zstd";
    case Compression::kLz4:
      return "lz4";
  }
  return "";
}

std::optional<Compression> compression_named(std::string_view name) {
  for (const auto compression : {Compression::kNone, Compression::kZstd, Compression::kLz4}) {
    if (name == name_of(compression)) return compression;
  }
  return std::nullopt;
}

struct Compressor::Context {
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> zstd{nullptr, ZSTD_freeCCtx};
};

Compressor::Compressor(Compression compression, int level)
    : compression_(compression), context_(std::make_unique<Context>()) {
  if (compression != Compression::kZstd) return;
  context_->zstd.reset(ZSTD_createCCtx());
  ZSTD_CCtx_setParameter(context_->zstd.get(), ZSTD_c_compressionLevel, level);
}
Compressor::~Compressor() = default;

bool Compressor::compress(ByteView bytes, Bytes& out) {
  std::size_t size = 0;
  if (compression_ == Compression::kZstd) {
    out.resize(ZSTD_compressBound(bytes.size()));
    size = ZSTD_compress2(context_->zstd.get(), out.data(), out.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size) != 0) return false;
  } else if (compression_ == Compression::kLz4) {
    LZ4F_preferences_t preferences = LZ4F_INIT_PREFERENCES;
    preferences.frameInfo.blockSizeID = LZ4F_max1MB;
    preferences.frameInfo.contentSize = bytes.size();
    out.resize(LZ4F_compressFrameBound(bytes.size(), &preferences));
    size = LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences);
    if (LZ4F_isError(size) != 0) return false;
  } else {
    return false;
  }
  out.resize(size);
  return size + bytes.size() / 50 < bytes.size();
}

bool decompress(Compression compression, ByteView bytes, std::uint64_t size, Bytes& out) {
  switch (compression) {
    case Compression::kNone:
      if (bytes.size() != size) return false;
      out.assign(bytes.begin(), bytes.end());
      return true;
    case Compression::kZstd:
      return decompress_zstd(bytes, size, out);
    case Compression::kLz4:
      return decompress_lz4(bytes, size, out);
  }
  return false;
}

}  // namespace cosight::recording
