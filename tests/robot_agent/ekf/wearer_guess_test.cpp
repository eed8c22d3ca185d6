// A worn frame's pixels linearised at a better guess of Cf's pose than its mean.
#include <gtest/gtest.h>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

/// A surveyed point between two cameras whose poses are given, and what the free one sees of it.
class WearerGuess : public testing::Test {
 protected:
  WearerGuess() {
    filter_.reset(UncertainPose{}, 0.1, 0.1);
    landmark_ = *filter_.add_known_point(p_W_, Eigen::Matrix3d::Zero());
    sensed_.camera_F = camera_;
    sensed_.T_SF.T = Pose{quaternion_exp({0.05, -0.1, 0.02}), {0.6, 0.1, -0.2}};
    sensed_.T_SF.covariance.diagonal().setConstant(0.01);
  }

  /// W and S are the same here.
  Eigen::Vector2d seen_from(const Pose& T_SF) const {
    return *camera_.project(T_SF.q.conjugate() * (p_W_ - T_SF.p));
  }
  Pose stepped(const Pose& T, const Eigen::Matrix<double, 6, 1>& step) const {
    return {quaternion_exp(step.tail<3>()) * T.q, T.p + step.head<3>()};
  }
  Eigen::Vector2d innovation(const Eigen::Vector2d& pixel, const StereoRig& rig) {
    const Measurement measurement = Measurement::wearer_pixel(landmark_, pixel, 1.0);
    return filter_.innovation({&measurement, 1}, &rig).measurements().front().innovation.head<2>();
  }

  const CameraModel camera_ = RandomScene(1).camera();
  const Eigen::Vector3d p_W_{0.4, -0.3, 3.0};
  Filter filter_{camera_, {}};
  LandmarkId landmark_ = 0;
  StereoRig sensed_;
};

TEST_F(WearerGuess, LeavesTheStepFromTheMeanInTheInnovation) {
  const Eigen::Matrix<double, 6, 1> error{0.05, -0.03, 0.04, 0.02, -0.03, 0.01};
  const Pose truth = stepped(sensed_.T_SF.T, error);
  StereoRig guessed = sensed_;
  guessed.has_guess = true;
  guessed.T_SF_guess = truth;
  constexpr double kStep = 1e-6;
  const Eigen::Vector2d derivative =
      (seen_from(stepped(truth, kStep * error)) - seen_from(stepped(truth, -kStep * error))) / (2.0 * kStep);
  EXPECT_LT((innovation(seen_from(truth), guessed) - derivative).norm(), 1e-4 * derivative.norm());
}

TEST_F(WearerGuess, ChangesNothingWhereItIsTheMean) {
  StereoRig guessed = sensed_;
  guessed.has_guess = true;
  guessed.T_SF_guess = sensed_.T_SF.T;
  const Eigen::Vector2d pixel = seen_from(sensed_.T_SF.T) + Eigen::Vector2d(3.0, -2.0);
  EXPECT_EQ(innovation(pixel, guessed), innovation(pixel, sensed_));
}

}  // namespace
}  // namespace cosight::ekf
