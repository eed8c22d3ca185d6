#include "shared/recording/field_writer.hpp"

namespace cosight::recording {

// Inlined, it makes GCC 12 see overflows that aren't there.
FieldWriter& FieldWriter::raw(ByteView bytes) {
  bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  return *this;
}

}  // namespace cosight::recording
