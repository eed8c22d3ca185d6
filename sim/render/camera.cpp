#include "sim/render/camera.hpp"

#include <stdexcept>

namespace cosight::sim {

Camera::Camera(const CameraModel& calibration) : calibration_(calibration) {
  if (calibration.distortion != Distortion::kNone && calibration.distortion != Distortion::kRadtan) {
    throw std::invalid_argument("the simulator renders distortion none and radtan only");
  }
  for (int y = 0; y < calibration.height; ++y) {
    for (int x = 0; x < calibration.width; ++x) {
      const Eigen::Vector2f ray = ray_through(Eigen::Vector2d(x, y)).cast<float>();
      rays_x_.push_back(ray.x());
      rays_y_.push_back(ray.y());
    }
  }
}

Eigen::Vector2d Camera::bend(const Eigen::Vector2d& ideal) const {
  if (calibration_.distortion == Distortion::kNone) return ideal;
  const auto& [k1, k2, p1, p2, k3] = calibration_.coefficients;
  const double x = ideal.x();
  const double y = ideal.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

std::optional<Eigen::Vector2d> Camera::pixel_of(const Eigen::Vector3d& p_C) const {
  if (p_C.z() <= 1e-6) return std::nullopt;
  const Eigen::Vector2d bent = bend(p_C.head<2>() / p_C.z());
  return Eigen::Vector2d{calibration_.fx * bent.x() + calibration_.cx,
                         calibration_.fy * bent.y() + calibration_.cy};
}

Eigen::Vector2d Camera::ray_through(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d bent{(pixel.x() - calibration_.cx) / calibration_.fx,
                             (pixel.y() - calibration_.cy) / calibration_.fy};
  Eigen::Vector2d ideal = bent;
  // Fixed point: each step takes off the bend at the present guess; a contraction for any sane lens.
  for (int step = 0; step < 100; ++step) {
    const Eigen::Vector2d error = bend(ideal) - bent;
    ideal -= error;
    if (error.squaredNorm() < 1e-26) break;
  }
  return ideal;
}

}  // namespace cosight::sim
