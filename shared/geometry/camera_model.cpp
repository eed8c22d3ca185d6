#include "shared/geometry/camera_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cosight {
namespace {

using Vector2 = Eigen::Vector2d;
using Matrix2 = Eigen::Matrix2d;

/// Distorted normalised coordinates and their Jacobian; nothing where the model folds back.
struct Distorted {
  Vector2 xy;
  Matrix2 J;
};

std::optional<Distorted> distort_radtan(const std::array<double, 5>& k, const Vector2& n) {
  const double x = n.x();
  const double y = n.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
  const double radial_r2 = k[0] + r2 * (2.0 * k[1] + 3.0 * k[4] * r2);  // d radial / d r2
  // Beyond the radius where r * radial(r) stops growing two rays share a pixel.
  if (radial + 2.0 * r2 * radial_r2 <= 0.0) return std::nullopt;
  Distorted d;
  d.xy.x() = x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x);
  d.xy.y() = y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y;
  d.J(0, 0) = radial + 2.0 * x * x * radial_r2 + 2.0 * k[2] * y + 6.0 * k[3] * x;
  d.J(0, 1) = 2.0 * x * y * radial_r2 + 2.0 * k[2] * x + 2.0 * k[3] * y;
  d.J(1, 0) = 2.0 * x * y * radial_r2 + 2.0 * k[2] * x + 2.0 * k[3] * y;
  d.J(1, 1) = radial + 2.0 * y * y * radial_r2 + 6.0 * k[2] * y + 2.0 * k[3] * x;
  return d;
}

/// xy scaled by s(r): J = s I + (ds/dr / r) xy xy^T.
Distorted scale_radially(const Vector2& n, double r, double s, double s_r) {
  Distorted d;
  d.xy = s * n;
  d.J = s * Matrix2::Identity();
  if (r > 1e-12) d.J += (s_r / r) * n * n.transpose();
  return d;
}

std::optional<Distorted> distort_equidistant(const std::array<double, 5>& k, const Vector2& n) {
  const double r = n.norm();
  if (r < 1e-8) return Distorted{n, Matrix2::Identity()};
  const double theta = std::atan(r);
  const double t2 = theta * theta;
  const double theta_d = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
  const double theta_d_theta =
      1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
  if (theta_d_theta <= 0.0) return std::nullopt;
  const double s = theta_d / r;
  const double s_r = (theta_d_theta / (1.0 + r * r) - s) / r;
  return scale_radially(n, r, s, s_r);
}

/// SceneLib's radius is in pixels; with equal focal lengths k f^2 makes it one of normalised coordinates.
Distorted distort_scenelib(double k_normalised, const Vector2& n) {
  const double r = n.norm();
  const double q = 1.0 + 2.0 * k_normalised * r * r;
  const double s = 1.0 / std::sqrt(q);
  return scale_radially(n, r, s, -2.0 * k_normalised * r * s / q);
}

std::optional<Distorted> distort(const CameraModel& camera, const Vector2& n) {
  switch (camera.distortion) {
    case Distortion::kRadtan:
      return distort_radtan(camera.coefficients, n);
    case Distortion::kEquidistant:
      return distort_equidistant(camera.coefficients, n);
    case Distortion::kScenelibWide:
      return distort_scenelib(camera.coefficients[0] * camera.fx * camera.fy, n);
    case Distortion::kNone:
      break;
  }
  return Distorted{n, Matrix2::Identity()};
}

/// Where Newton's method starts: for a fisheye the angle is nearly the radius, and its tangent is far from
/// it.
Vector2 first_guess(const CameraModel& camera, const Vector2& target) {
  if (camera.distortion != Distortion::kEquidistant) return target;
  const double theta_d = target.norm();
  if (theta_d < 1e-8) return target;
  const auto& k = camera.coefficients;
  constexpr double kMaxAngle = 1.57;
  double theta = std::min(theta_d, kMaxAngle);
  for (int i = 0; i < 10; ++i) {
    const double t2 = theta * theta;
    const double value = theta * (1.0 + t2 * (k[0] + t2 * (k[1] + t2 * (k[2] + t2 * k[3]))));
    const double slope = 1.0 + t2 * (3.0 * k[0] + t2 * (5.0 * k[1] + t2 * (7.0 * k[2] + t2 * 9.0 * k[3])));
    if (slope <= 0.0) break;
    theta = std::clamp(theta + (theta_d - value) / slope, 0.0, kMaxAngle);
  }
  return std::tan(theta) / theta_d * target;
}

}  // namespace

std::optional<Eigen::Vector2d> CameraModel::project(const Eigen::Vector3d& p_C,
                                                    Eigen::Matrix<double, 2, 3>* J) const {
  constexpr double kMinDepth = 1e-9;
  if (!(p_C.z() > kMinDepth)) return std::nullopt;
  const Vector2 n = p_C.head<2>() / p_C.z();
  const auto d = distort(*this, n);
  if (!d) return std::nullopt;
  if (J != nullptr) {
    Eigen::Matrix<double, 2, 3> J_n;
    J_n << 1.0, 0.0, -n.x(), 0.0, 1.0, -n.y();
    *J = Vector2(fx, fy).asDiagonal() * d->J * J_n / p_C.z();
  }
  return Vector2(fx * d->xy.x() + cx, fy * d->xy.y() + cy);
}

std::optional<Eigen::Vector3d> CameraModel::unproject(const Eigen::Vector2d& pixel,
                                                      Eigen::Matrix<double, 3, 2>* J) const {
  const Vector2 target((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (!target.allFinite()) return std::nullopt;
  Vector2 n = first_guess(*this, target);
  Matrix2 J_d = Matrix2::Identity();
  if (distortion != Distortion::kNone) {
    constexpr int kMaxIterations = 30;
    const double tolerance = 1e-12 * std::max(1.0, n.norm());
    bool converged = false;
    for (int i = 0; i < kMaxIterations && !converged; ++i) {
      const auto d = distort(*this, n);
      if (!d) {  // stepped over the fold: come back towards the axis
        n *= 0.7;
        continue;
      }
      J_d = d->J;
      const Vector2 step = J_d.inverse() * (target - d->xy);
      n += step;
      converged = step.squaredNorm() < tolerance * tolerance;
    }
    if (!converged || !n.allFinite()) return std::nullopt;
    const auto d = distort(*this, n);
    if (!d || (d->xy - target).norm() > 1e-9) return std::nullopt;
    J_d = d->J;
  }
  if (J != nullptr) {
    J->setZero();
    J->topRows<2>() = J_d.inverse() * Vector2(1.0 / fx, 1.0 / fy).asDiagonal();
  }
  return Eigen::Vector3d(n.x(), n.y(), 1.0);
}

}  // namespace cosight
