#pragma once

#include <stdexcept>

namespace cosight {

/// A file of results that can't be read or written, or two that have nothing in common. The message names
/// file and line, and what to do.
class EvaluationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cosight
