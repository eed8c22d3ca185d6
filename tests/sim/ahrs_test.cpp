#include "sim/sensors/ahrs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cosight::sim {
namespace {

constexpr double kDegree = 0.017453292519943295;

double yaw_of(const Eigen::Quaterniond& q) {
  const Eigen::Vector3d forward = q * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

Pose facing(double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {0, 0, 1.65}};
}

TEST(SimulateAhrs, ErrsAsMuchAsItsCovarianceSays) {
  AhrsPlan plan;
  plan.wander_time = 2.0;
  const auto samples = simulate_ahrs(
      plan, [](double) { return facing(0.3); }, 2000.0, 1);
  double yaw_squares = 0.0;
  double tilt_squares = 0.0;
  for (const AhrsSample& sample : samples) {
    const Eigen::Quaterniond error = sample.q_WH * facing(0.3).q.conjugate();
    yaw_squares += std::pow(yaw_of(error), 2);
    tilt_squares += std::pow((error * Eigen::Vector3d::UnitZ()).x(), 2);
  }
  const double count = static_cast<double>(samples.size());
  EXPECT_NEAR(std::sqrt(yaw_squares / count), 1.0 * kDegree, 0.08 * kDegree);
  EXPECT_NEAR(std::sqrt(tilt_squares / count), 0.5 * kDegree, 0.04 * kDegree);
  EXPECT_NEAR(std::sqrt(samples[0].orientation_covariance(2, 2)), 1.0 * kDegree, 0.01 * kDegree);
  EXPECT_NEAR(std::sqrt(samples[0].orientation_covariance(0, 0)), 0.5 * kDegree, 0.01 * kDegree);
}

TEST(SimulateAhrs, NamesItsOwnNorth) {
  AhrsPlan plan{.roll_pitch_sigma = 0, .yaw_sigma = 0, .white_sigma = 0, .north_offset = 0.8};
  const auto samples = simulate_ahrs(
      plan, [](double) { return facing(0.3); }, 0.5, 1);
  EXPECT_NEAR(yaw_of(samples[7].q_WH), 1.1, 1e-9);
}

TEST(SimulateAhrs, SwingsInADisturbedField) {
  AhrsPlan plan{
      .roll_pitch_sigma = 0, .yaw_sigma = 0, .white_sigma = 0, .disturbance = 0.2, .disturbance_time = 10};
  const auto samples = simulate_ahrs(
      plan, [](double) { return facing(0.0); }, 10.0, 1);
  double low = 0.0;
  double high = 0.0;
  for (const AhrsSample& sample : samples) {
    low = std::min(low, yaw_of(sample.q_WH));
    high = std::max(high, yaw_of(sample.q_WH));
  }
  EXPECT_NEAR(low, -0.2, 1e-3);
  EXPECT_NEAR(high, 0.2, 1e-3);
}

TEST(SimulateAhrs, FeelsTheTurnOfTheHead) {
  const auto samples = simulate_ahrs(
      {.gyro_sigma = 0}, [](double t) { return facing(0.5 * t); }, 1.0, 1);
  EXPECT_NEAR((samples[50].angular_velocity_H - Eigen::Vector3d(0, 0, 0.5)).norm(), 0.0, 1e-6);
}

}  // namespace
}  // namespace cosight::sim
