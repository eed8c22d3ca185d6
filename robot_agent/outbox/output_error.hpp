#pragma once

#include <stdexcept>

namespace cosight::outbox {

/// The run's results can't be written: no permission, no room. Says where and what to do about it.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cosight::outbox
