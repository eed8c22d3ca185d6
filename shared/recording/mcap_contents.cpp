#include "shared/recording/mcap_contents.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "shared/recording/recording_error.hpp"
#include "shared/recording/scanned_contents.hpp"
#include "shared/recording/summary_contents.hpp"

namespace cosight::recording {
namespace {

/// A file of which no more than a part of the magic was written is an empty recording, not a foreign file.
void require_magic(const ByteSource& source) {
  std::array<std::uint8_t, kMagic.size()> magic{};
  const std::size_t count = source.read(0, magic);
  if (!std::equal(magic.begin(), magic.begin() + static_cast<std::ptrdiff_t>(count), kMagic.begin()))
    throw RecordingError("recording " + source.name() + " is not an MCAP file");
}

}  // namespace

McapContents read_contents(const ByteSource& source, const ReaderLimits& limits) {
  require_magic(source);
  if (auto contents = summary_contents(source)) return std::move(*contents);
  return scanned_contents(source, limits);
}

}  // namespace cosight::recording
