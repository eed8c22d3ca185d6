#pragma once

#include <stdexcept>

namespace cosight {

/// An input that can't be opened; one sentence that names file and line and says what would do.
class DatasetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cosight
