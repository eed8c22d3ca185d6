#include "tests/robot_agent/vins/synthetic_drive.hpp"

#include <cmath>
#include <random>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

constexpr double kFocalLength = 460.0;

Vector3d position(double t) {
  return {4.0 * std::sin(0.5 * t), 3.0 * std::cos(0.6 * t), 1.0 + 0.5 * std::sin(0.9 * t)};
}
Vector3d velocity(double t) {
  return {2.0 * std::cos(0.5 * t), -1.8 * std::sin(0.6 * t), 0.45 * std::cos(0.9 * t)};
}
Vector3d acceleration(double t) {
  return {-1.0 * std::sin(0.5 * t), -1.08 * std::cos(0.6 * t), -0.405 * std::sin(0.9 * t)};
}

/// Yaw, then a little pitch and roll.
Eigen::Quaterniond orientation(double t) {
  return Eigen::AngleAxisd(0.3 * std::sin(0.7 * t), Vector3d::UnitZ()) *
         Eigen::AngleAxisd(0.2 * std::sin(0.8 * t + 1.0), Vector3d::UnitY()) *
         Eigen::AngleAxisd(0.15 * std::cos(0.6 * t), Vector3d::UnitX());
}

/// Body rate by a central difference of the orientation: exact to 1e-9 rad/s here.
Vector3d body_rate(double t) {
  constexpr double kStep = 1e-4;
  return quaternion_log(orientation(t - kStep).conjugate() * orientation(t + kStep)) / (2.0 * kStep);
}

}  // namespace

SyntheticDrive::SyntheticDrive(unsigned seed, int points) : random_(seed * 2654435761ULL + 1ULL) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> x(8.0, 25.0);
  std::uniform_real_distribution<double> y(-15.0, 15.0);
  std::uniform_real_distribution<double> z(-6.0, 8.0);
  for (int i = 0; i < points; ++i)
    points_W_.emplace_back(x(generator), y(generator), z(generator));
}

double SyntheticDrive::gaussian() {
  std::mt19937_64 generator(random_++);
  return std::normal_distribution<double>()(generator);
}

Pose SyntheticDrive::T_BS() const {
  Eigen::Matrix3d R_BS;  // optical axes: x right, y down, z forward
  R_BS << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return {Eigen::Quaterniond(R_BS) * quaternion_exp(Vector3d(0.01, -0.02, 0.015)),
          Vector3d(0.1, 0.03, -0.05)};
}

NavState SyntheticDrive::state(double t) const {
  return {{orientation(t), position(t)}, velocity(t), bias};
}

double SyntheticDrive::distance(FeatureId id, double t) const {
  return (points_W_[id] - (state(t).T_WB * T_BS()).p).norm();
}

std::vector<ImuSample> SyntheticDrive::imu(double from, double to) {
  constexpr double kRate = 200.0;
  const double accelerometer = noisy ? noise.accelerometer * std::sqrt(kRate) : 0.0;
  const double gyroscope = noisy ? noise.gyroscope * std::sqrt(kRate) : 0.0;
  std::vector<ImuSample> samples;
  const int count = static_cast<int>(std::lround((to - from) * kRate));
  for (int i = 0; i <= count; ++i) {
    const double t = from + i / kRate;
    const Vector3d force_W = acceleration(t) + Vector3d(0.0, 0.0, gravity);
    ImuSample sample;
    sample.stamp = stamp(t);
    sample.acceleration_B = orientation(t).conjugate() * force_W + bias.accelerometer;
    sample.angular_velocity_B = body_rate(t) + bias.gyroscope;
    for (int axis = 0; axis < 3; ++axis)
      sample.acceleration_B(axis) += accelerometer * gaussian();
    for (int axis = 0; axis < 3; ++axis)
      sample.angular_velocity_B(axis) += gyroscope * gaussian();
    samples.push_back(sample);
  }
  return samples;
}

FeatureFrame SyntheticDrive::camera(double t, double pixel_noise) {
  const Pose T_SW = (state(t).T_WB * T_BS()).inverse();
  FeatureFrame frame{stamp(t), {}};
  for (std::size_t i = 0; i < points_W_.size(); ++i) {
    const Vector3d p_S = T_SW * points_W_[i];
    if (p_S.z() < 0.5 || std::abs(p_S.x()) > 0.8 * p_S.z() || std::abs(p_S.y()) > 0.6 * p_S.z()) continue;
    TrackedFeature feature{i, {}};
    feature.sighting.point = p_S.hnormalized();
    feature.sighting.point.x() += pixel_noise / kFocalLength * gaussian();
    feature.sighting.point.y() += pixel_noise / kFocalLength * gaussian();
    frame.features.push_back(feature);
  }
  return frame;
}

}  // namespace cosight::vins
