#pragma once

#include <stdexcept>

namespace cosight::recording {

/// A recording can't be opened, read or written: names the file and says what to do.
class RecordingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cosight::recording
