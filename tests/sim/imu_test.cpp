#include "sim/sensors/imu.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/motion/robot_motion.hpp"

namespace cosight::sim {
namespace {

ImuPlan perfect() {
  ImuPlan plan;
  plan.timing.rate = 400.0;
  plan.gyro_density = plan.gyro_bias = plan.gyro_bias_wander = 0.0;
  plan.acceleration_density = plan.acceleration_bias = plan.acceleration_bias_wander = 0.0;
  return plan;
}

RobotMotion around_a_corner() {
  return {PathPlan{{{0, 0}, {3, 0}, {3, 3}}, 1.0, 0.8, 1.5, 0.5}, Shaking{}, 4};
}

TEST(SimulateImu, IntegratesBackToItsTrajectory) {
  const RobotMotion robot = around_a_corner();
  ImuPlan plan = perfect();
  plan.T_BI.p = {0.1, -0.05, 0.2};
  const double duration = robot.path().duration();
  const auto samples = simulate_imu(
      plan, [&](double t) { return robot.at(t); }, duration, 1);
  // Dead reckoning by the midpoint rule, with a gravity of its own.
  const Eigen::Vector3d gravity(0.0, 0.0, -9.80665);
  Pose T_WI = robot.at(0.0) * plan.T_BI;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const ImuSample& before = samples[k - 1].measured;
    const ImuSample& now = samples[k].measured;
    const double dt = to_seconds(now.stamp - before.stamp);
    const Eigen::Vector3d turn = 0.5 * dt * (before.angular_velocity_I + now.angular_velocity_I);
    const Eigen::Quaterniond q_next =
        turn.norm() > 0 ? Eigen::Quaterniond(T_WI.q * Eigen::AngleAxisd(turn.norm(), turn.normalized()))
                        : T_WI.q;
    const Eigen::Vector3d acceleration =
        0.5 * (T_WI.q * before.acceleration_I + q_next * now.acceleration_I) + gravity;
    T_WI.p += dt * velocity + 0.5 * dt * dt * acceleration;
    velocity += dt * acceleration;
    T_WI.q = q_next.normalized();
  }
  const Pose expected = robot.at(duration) * plan.T_BI;
  EXPECT_LT((T_WI.p - expected.p).norm(), 0.003);
  EXPECT_LT(T_WI.q.angularDistance(expected.q), 1e-4);
  EXPECT_LT(velocity.norm(), 0.003) << "it stands at the end";
}

TEST(SimulateImu, FeelsOnlyGravityAtRest) {
  const auto samples = simulate_imu(
      perfect(), [](double) { return Pose{}; }, 0.1, 1);
  EXPECT_NEAR((samples[3].measured.acceleration_I - Eigen::Vector3d(0, 0, 9.80665)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(samples[3].measured.angular_velocity_I.norm(), 0.0, 1e-12);
}

TEST(SimulateImu, HasTheNoiseOfItsDensityAndTheBiasThatItReports) {
  ImuPlan plan;  // the default class
  const auto samples = simulate_imu(
      plan, [](double) { return Pose{}; }, 100.0, 3);
  double squares = 0.0;
  for (const BiasedImuSample& sample : samples) {
    squares += (sample.measured.angular_velocity_I - sample.gyro_bias).squaredNorm();
  }
  const double deviation = std::sqrt(squares / (3.0 * static_cast<double>(samples.size())));
  EXPECT_NEAR(deviation, plan.gyro_density * std::sqrt(200.0), 0.03 * deviation);
  EXPECT_GT(samples.front().gyro_bias.norm(), 1e-4);
  EXPECT_NE(samples.front().gyro_bias, samples.back().gyro_bias);
}

}  // namespace
}  // namespace cosight::sim
