#pragma once

#include <stdexcept>

namespace cosight {

/// Real data that is not as its README says; the message names the file and what to do.
class PrepareError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace cosight
