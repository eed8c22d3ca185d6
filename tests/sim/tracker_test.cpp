#include "sim/sensors/tracker.hpp"

#include <gtest/gtest.h>

#include "shared/geometry/rotation.hpp"

namespace cosight::sim {
namespace {

/// Average normalised error squared over 2000 frames, as uncertain_pose.hpp defines the error.
double average_nees(const TrackerPlan& plan) {
  const Pose T_SF{quaternion_exp({0.2, -0.5, 0.3}), {0.4, 0.1, 1.5}};
  double sum = 0.0;
  for (std::uint64_t frame = 0; frame < 2000; ++frame) {
    const UncertainPose measured = track(plan, T_SF, 11, frame);
    Eigen::Matrix<double, 6, 1> error;
    error << T_SF.p - measured.T.p, quaternion_log(T_SF.q * measured.T.q.conjugate());
    sum += error.dot(measured.covariance.inverse() * error);
  }
  return sum / 2000.0;
}

TEST(Track, ErrsAsMuchAsItsCovarianceSays) {
  // Six degrees of freedom, 2000 draws: 99.9 % of averages are within 6 +- 0.26.
  EXPECT_NEAR(average_nees({}), 6.0, 0.3);
  EXPECT_NEAR(average_nees({.position_sigma = {0.05, 0.02, 0.01}, .rotation_sigma = {0.01, 0.02, 0.005}}),
              6.0, 0.3);
}

}  // namespace
}  // namespace cosight::sim
