#include "experiments/urban_canyon/gaussian.hpp"

namespace cosight::experiments {

Eigen::Vector3d gaussian(std::mt19937_64& random, double sigma) {
  std::normal_distribution<double> draw(0.0, sigma);
  const double x = draw(random);
  const double y = draw(random);
  return {x, y, draw(random)};
}

}  // namespace cosight::experiments
