#pragma once

#include "shared/recording/byte_source.hpp"
#include "shared/recording/mcap_contents.hpp"

namespace cosight::recording {

/// The records of a segment, decompressed and checked against their checksum. False when it is damaged; then
/// `records` holds what can be used nevertheless: the beginning of an uncompressed chunk that was cut off.
bool read_segment(const ByteSource& source, const Segment& segment, const ReaderLimits& limits,
                  Bytes& records);

}  // namespace cosight::recording
