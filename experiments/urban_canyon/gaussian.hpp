#pragma once

#include <Eigen/Core>
#include <random>

namespace cosight::experiments {

/// kSize independent normal draws of standard deviation `sigma`.
template <int kSize>
Eigen::Vector<double, kSize> gaussian(std::mt19937_64& random, double sigma) {
  std::normal_distribution<double> draw(0.0, sigma);
  Eigen::Vector<double, kSize> drawn;
  for (double& x : drawn)
    x = draw(random);
  return drawn;
}

}  // namespace cosight::experiments
