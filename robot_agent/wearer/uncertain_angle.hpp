#pragma once

namespace cosight::wearer {

/// An angle with the standard deviation of its error [rad].
struct UncertainAngle {
  double angle = 0.0;
  double sigma = 0.0;
};

}  // namespace cosight::wearer
