#include "sim/sensors/wander.hpp"

#include <cmath>

namespace cosight::sim {

Wander::Wander(double sigma, double time_constant, RandomStream random)
    : sigma_(sigma), time_constant_(time_constant), random_(random), value_(sigma * random_.normal()) {}

double Wander::advance(double step) {
  const double kept = std::exp(-step / time_constant_);
  value_ = kept * value_ + sigma_ * std::sqrt(1.0 - kept * kept) * random_.normal();
  return value_;
}

}  // namespace cosight::sim
