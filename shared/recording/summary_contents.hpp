#pragma once

#include <optional>

#include "shared/recording/mcap_contents.hpp"

namespace cosight::recording {

/// From the file's end alone; nothing when there is no summary, or one that does not say everything.
std::optional<McapContents> summary_contents(const ByteSource& source);

/// What a header record says. False: there is none.
bool read_header(const ByteSource& source, McapContents& contents);

}  // namespace cosight::recording
