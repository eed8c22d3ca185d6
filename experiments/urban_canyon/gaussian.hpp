#pragma once

#include <Eigen/Core>
#include <random>

namespace cosight::experiments {

/// Three independent normal draws of standard deviation `sigma`.
Eigen::Vector3d gaussian(std::mt19937_64& random, double sigma);

}  // namespace cosight::experiments
