#pragma once

#include <cstdint>

#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/mcap_writer.hpp"

namespace cosight::recording {

struct Recovered {
  std::uint64_t messages = 0;
  std::uint64_t attachments = 0;
  std::uint64_t damaged = 0;  ///< chunks and records that could not be saved
};

/// A whole file with everything that can still be read of another, in its order.
Recovered recover(const McapReader& reader, ByteSink& sink, const WriterOptions& options = {});

}  // namespace cosight::recording
