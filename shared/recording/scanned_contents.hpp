#pragma once

#include "shared/recording/mcap_contents.hpp"

namespace cosight::recording {

/// From the whole file, record by record up to where it ends or makes no sense any more.
McapContents scanned_contents(const ByteSource& source, const ReaderLimits& limits);

}  // namespace cosight::recording
