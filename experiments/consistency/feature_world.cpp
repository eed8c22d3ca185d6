#include "experiments/consistency/feature_world.hpp"

#include <cmath>

namespace cosight::experiments {
namespace {

std::optional<Eigen::Vector2d> project(const FeatureWorld::Body& camera, const Eigen::Vector3d& p_W) {
  constexpr double kNearest = 0.5;  // [m]
  const Eigen::Vector3d p = camera.R.transpose() * (p_W - camera.p);
  if (p.z() < kNearest) return std::nullopt;
  const Eigen::Vector2d pixel(FeatureWorld::kFocal * p.x() / p.z() + 0.5 * FeatureWorld::kWidth,
                              FeatureWorld::kFocal * p.y() / p.z() + 0.5 * FeatureWorld::kHeight);
  const bool inside = pixel.x() > 0.0 && pixel.y() > 0.0 && pixel.x() < FeatureWorld::kWidth &&
                      pixel.y() < FeatureWorld::kHeight;
  return inside ? std::optional(pixel) : std::nullopt;
}

}  // namespace

FeatureWorld::FeatureWorld(unsigned seed, const FeatureWorldOptions& options)
    : options_(options), rng_(seed) {
  camera_.R << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;  // looks along x, z of W is up
  if (options.shape == WorldShape::kBox) {
    fill_box();
    v_ = 0.2 * draw();
    omega_ = 0.1 * draw();
  } else {
    fill_corridor();
    v_ = Eigen::Vector3d(options.speed, 0.0, 0.0) + 0.05 * draw();
    omega_ = 0.02 * draw();
  }
  place_wearer();
  if (options.wearer_error_time > 0.0) {
    wearer_error_ << draw(), draw();
  } else {
    wearer_error_.setZero();
  }
}

void FeatureWorld::fill_box() {
  constexpr double kClear = 2.5;  // [m] around the start
  std::uniform_real_distribution<double> side(-options_.half_size, options_.half_size);
  while (static_cast<int>(points_.size()) < options_.points) {
    const Eigen::Vector3d p(side(rng_), side(rng_), 0.5 * side(rng_));
    if (p.norm() > kClear) points_.push_back(p);
  }
}

void FeatureWorld::fill_corridor() {
  constexpr double kHalfWidth = 1.2;  // [m]
  constexpr double kFloor = -1.0;     // [m] below the camera
  constexpr double kCeiling = 1.6;    // [m] above it
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < options_.points; ++i) {
    const double x = options_.length * unit(rng_) - 1.0;
    const double across = kHalfWidth * (2.0 * unit(rng_) - 1.0);
    const double up = kFloor + (kCeiling - kFloor) * unit(rng_);
    const double surface = unit(rng_);
    if (surface < 0.4) {
      points_.emplace_back(x, kHalfWidth, up);
    } else if (surface < 0.8) {
      points_.emplace_back(x, -kHalfWidth, up);
    } else {
      points_.emplace_back(x, across, surface < 0.9 ? kFloor : kCeiling);
    }
  }
}

void FeatureWorld::step() {
  v_ += options_.dt * options_.sigma_acceleration * draw();
  omega_ += options_.dt * options_.sigma_angular_acceleration * draw();
  camera_.p += options_.dt * v_;
  camera_.R *= rodrigues(options_.dt * omega_);
  place_wearer();
}

std::vector<FeatureWorld::Seen> FeatureWorld::observe(bool wearer_present) {
  std::vector<Seen> seen;
  for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
    const auto pixel = project(camera_, point(i));
    if (!pixel) continue;
    Seen s{i, *pixel + noise(), std::nullopt};
    const auto other = project(wearer_, point(i));
    if (other && wearer_present) s.pixel_F = *other + noise();
    seen.push_back(s);
  }
  return seen;
}

FeatureWorld::Body FeatureWorld::measured_wearer() {
  Body T_SF{camera_.R.transpose() * wearer_.R, camera_.R.transpose() * (wearer_.p - camera_.p)};
  const double kept =
      options_.wearer_error_time > 0.0 ? std::exp(-options_.dt / options_.wearer_error_time) : 0.0;
  const double fresh = std::sqrt(1.0 - kept * kept);
  wearer_error_.head<3>() = kept * wearer_error_.head<3>() + fresh * draw();
  wearer_error_.tail<3>() = kept * wearer_error_.tail<3>() + fresh * draw();
  T_SF.p += options_.wearer_sigma_p * wearer_error_.head<3>();
  T_SF.R = rodrigues(options_.wearer_sigma_theta * wearer_error_.tail<3>()) * T_SF.R;
  return T_SF;
}

Eigen::Vector3d FeatureWorld::draw() {
  return {normal_(rng_), normal_(rng_), normal_(rng_)};
}

Eigen::Matrix3d FeatureWorld::rodrigues(const Eigen::Vector3d& turn) {
  const double angle = turn.norm();
  if (angle < 1e-12) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d u = turn / angle;
  Eigen::Matrix3d U;
  U << 0.0, -u.z(), u.y(), u.z(), 0.0, -u.x(), -u.y(), u.x(), 0.0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * U + (1.0 - std::cos(angle)) * U * U;
}

/// The wearer walks beside the robot and looks the same way, more or less.
void FeatureWorld::place_wearer() {
  wearer_.p = camera_.p + camera_.R * Eigen::Vector3d(1.2, -0.2, 0.1);
  wearer_.R = camera_.R * rodrigues({0.02, -0.15, 0.03});
}

}  // namespace cosight::experiments
