#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

namespace cosight::experiments {

enum class WorldShape {
  kBox,       ///< points fill a box around the start
  kCorridor,  ///< points on the walls, floor and ceiling of a corridor that the camera looks along
};

/// A world of points that two pinhole cameras see, with exact truth and known association. It shares nothing
/// with the filter: rotation matrices by Rodrigues' formula, its own projection, its own draws.
struct FeatureWorldOptions {
  WorldShape shape = WorldShape::kCorridor;
  double dt = 0.1;                           ///< [s]
  double sigma_acceleration = 0.1;           ///< [m/s^2] new in each step, as an impulse
  double sigma_angular_acceleration = 0.05;  ///< [rad/s^2]
  double pixel_sigma = 1.0;                  ///< [px] both cameras
  double wearer_sigma_p = 0.02;              ///< [m] each axis of T_SF
  double wearer_sigma_theta = 0.005;         ///< [rad] each axis of T_SF
  double wearer_error_time = 0.0;            ///< correlation time of both [s]; 0: new in every frame
  int points = 900;
  double half_size = 8.0;  ///< of the box [m]
  double length = 40.0;    ///< of the corridor [m]
  double speed = 0.8;      ///< along the corridor at the start [m/s]
};

class FeatureWorld {
 public:
  struct Body {
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< camera axes in W
    Eigen::Vector3d p = Eigen::Vector3d::Zero();      ///< [m]
  };
  struct Seen {
    int point = 0;
    Eigen::Vector2d pixel_S = Eigen::Vector2d::Zero();  ///< noisy [px]
    std::optional<Eigen::Vector2d> pixel_F;             ///< noisy [px]
  };

  static constexpr double kFocal = 450.0;  ///< [px] both cameras
  static constexpr int kWidth = 640;
  static constexpr int kHeight = 480;

  FeatureWorld(unsigned seed, const FeatureWorldOptions& options);

  /// Truth moves on by one step: a random walk of both velocities.
  void step();
  /// All points in view of the SLAM camera, with pixel noise.
  std::vector<Seen> observe(bool wearer_present);
  /// Pose of the free camera in the SLAM camera as the sensors tell it. To be called once a step: each call
  /// moves its error on.
  Body measured_wearer();

  const Body& camera() const { return camera_; }
  const Eigen::Vector3d& velocity() const { return v_; }
  const Eigen::Vector3d& angular_velocity() const { return omega_; }
  const Eigen::Vector3d& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  double distance(int point_index) const { return (point(point_index) - camera_.p).norm(); }
  /// Three independent standard normal numbers.
  Eigen::Vector3d draw();

  /// Rotation by |turn| about turn.
  static Eigen::Matrix3d rodrigues(const Eigen::Vector3d& turn);

 private:
  void fill_box();
  void fill_corridor();
  void place_wearer();
  Eigen::Vector2d noise() { return options_.pixel_sigma * draw().head<2>(); }

  FeatureWorldOptions options_;
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
  std::vector<Eigen::Vector3d> points_;
  Body camera_;
  Body wearer_;
  Eigen::Matrix<double, 6, 1> wearer_error_;  ///< of T_SF, in standard deviations
  Eigen::Vector3d v_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d omega_ = Eigen::Vector3d::Zero();
};

}  // namespace cosight::experiments
