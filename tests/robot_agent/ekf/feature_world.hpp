#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

namespace cosight::ekf {

/// A world of points that two pinhole cameras see, with exact truth and known association. It shares nothing
/// with the filter: rotation matrices by Rodrigues' formula, its own projection, its own draws.
struct FeatureWorldOptions {
  double dt = 0.1;                          ///< [s]
  double sigma_acceleration = 0.4;          ///< [m/s^2]
  double sigma_angular_acceleration = 0.3;  ///< [rad/s^2]
  double pixel_sigma = 1.0;                 ///< [px] both cameras
  double wearer_sigma_p = 0.02;             ///< [m] each axis
  double wearer_sigma_theta = 0.005;        ///< [rad] each axis
  int points = 600;
  double half_size = 8.0;  ///< of the box that the points fill [m]
};

class FeatureWorld {
 public:
  struct Body {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< camera axes in W
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
  };
  struct Seen {
    int point = 0;
    Eigen::Vector2d pixel_S = Eigen::Vector2d::Zero();  ///< noisy
    std::optional<Eigen::Vector2d> pixel_F;             ///< noisy
  };

  static constexpr double kFocal = 450.0;
  static constexpr int kWidth = 640;
  static constexpr int kHeight = 480;

  FeatureWorld(unsigned seed, const FeatureWorldOptions& options) : options_(options), rng_(seed) {
    std::uniform_real_distribution<double> side(-options.half_size, options.half_size);
    while (static_cast<int>(points_.size()) < options.points) {
      const Eigen::Vector3d p(side(rng_), side(rng_), 0.5 * side(rng_));
      if (p.norm() > 2.5) points_.push_back(p);  // none where the cameras start
    }
    camera_.R << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;  // looks along x, z of W is up
    v_ = 0.2 * draw();
    omega_ = 0.1 * draw();
    place_wearer();
  }

  /// Truth moves on by one step.
  void step() {
    v_ += options_.dt * options_.sigma_acceleration * draw();
    omega_ += options_.dt * options_.sigma_angular_acceleration * draw();
    camera_.p += options_.dt * v_;
    camera_.R *= rodrigues(options_.dt * omega_);
    place_wearer();
  }

  /// All points in view of the SLAM camera, with pixel noise.
  std::vector<Seen> observe(bool wearer_present) {
    std::vector<Seen> seen;
    for (int i = 0; i < static_cast<int>(points_.size()); ++i) {
      const auto pixel = project(camera_, points_[static_cast<std::size_t>(i)]);
      if (!pixel) continue;
      Seen s{i, *pixel + noise(), std::nullopt};
      const auto other = project(wearer_, points_[static_cast<std::size_t>(i)]);
      if (other && wearer_present) s.pixel_F = *other + noise();
      seen.push_back(s);
    }
    return seen;
  }

  /// Pose of the free camera in the SLAM camera as the sensors tell it, with a fresh error each call.
  Body measured_wearer() {
    Body T_SF{camera_.R.transpose() * wearer_.R, camera_.R.transpose() * (wearer_.p - camera_.p)};
    T_SF.p += options_.wearer_sigma_p * draw();
    T_SF.R = rodrigues(options_.wearer_sigma_theta * draw()) * T_SF.R;
    return T_SF;
  }

  const Body& camera() const { return camera_; }
  const Eigen::Vector3d& velocity() const { return v_; }
  const Eigen::Vector3d& angular_velocity() const { return omega_; }
  const Eigen::Vector3d& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  const FeatureWorldOptions& options() const { return options_; }
  Eigen::Vector3d draw() { return {normal_(rng_), normal_(rng_), normal_(rng_)}; }

  static Eigen::Matrix3d rodrigues(const Eigen::Vector3d& turn) {
    const double angle = turn.norm();
    if (angle < 1e-12) return Eigen::Matrix3d::Identity();
    const Eigen::Vector3d u = turn / angle;
    Eigen::Matrix3d U;
    U << 0.0, -u.z(), u.y(), u.z(), 0.0, -u.x(), -u.y(), u.x(), 0.0;
    return Eigen::Matrix3d::Identity() + std::sin(angle) * U + (1.0 - std::cos(angle)) * U * U;
  }

  static std::optional<Eigen::Vector2d> project(const Body& camera, const Eigen::Vector3d& p_W) {
    const Eigen::Vector3d p = camera.R.transpose() * (p_W - camera.p);
    if (p.z() < 0.5) return std::nullopt;
    const Eigen::Vector2d pixel(kFocal * p.x() / p.z() + 0.5 * kWidth,
                                kFocal * p.y() / p.z() + 0.5 * kHeight);
    const bool inside = pixel.x() > 0.0 && pixel.y() > 0.0 && pixel.x() < kWidth && pixel.y() < kHeight;
    return inside ? std::optional(pixel) : std::nullopt;
  }

 private:
  /// The wearer walks beside the robot and looks the same way, more or less.
  void place_wearer() {
    wearer_.p = camera_.p + camera_.R * Eigen::Vector3d(1.2, -0.2, 0.1);
    wearer_.R = camera_.R * rodrigues({0.02, -0.15, 0.03});
  }
  Eigen::Vector2d noise() { return options_.pixel_sigma * draw().head<2>(); }

  FeatureWorldOptions options_;
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector3d> points_;
  Body camera_;
  Body wearer_;
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();
};

}  // namespace cosight::ekf
