#pragma once

#include "sim/random.hpp"

namespace cosight::sim {

/// A first order Gauss-Markov process: mean 0, standard deviation `sigma` at all times, forgets itself over
/// `time_constant` [s].
class Wander {
 public:
  Wander(double sigma, double time_constant, RandomStream random);

  /// Its value `step` [s] after the last call.
  double advance(double step);

 private:
  double sigma_, time_constant_;
  RandomStream random_;
  double value_;
};

}  // namespace cosight::sim
