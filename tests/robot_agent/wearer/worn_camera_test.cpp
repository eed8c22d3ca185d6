#include "robot_agent/wearer/worn_camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "shared/geometry/rotation.hpp"

namespace cosight::wearer {
namespace {

Eigen::Quaterniond turned(double yaw) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
}

const Stamp kNow = from_seconds(10.0);

AhrsSample head(double yaw_A, double pitch = 0.0, Stamp stamp = kNow) {
  AhrsSample sample;
  sample.stamp = stamp;
  sample.q_WH = turned(yaw_A) * Eigen::Quaterniond(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
  sample.orientation_covariance = 1e-4 * Eigen::Matrix3d::Identity();
  return sample;
}

/// Robot one metre ahead in O and turned; the wearer at (3, 1) looks along 0.5 rad of W.
struct Situation {
  double yaw_OW = 0.7, yaw_WA = -0.4, gaze_W = 0.5, pitch = 0.2;
  Pose T_OB{turned(0.3), {1.0, 0.0, 0.0}};
  Eigen::Vector2d p_O{3.0, 1.0};

  Eigen::Vector3d truth_S(const HeadOptions& options) const {
    const Eigen::Vector3d lever =
        turned(yaw_OW + gaze_W) *
        (Eigen::Quaterniond(Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY())) * options.p_HF);
    const Eigen::Vector3d p_F_O = Eigen::Vector3d(p_O.x(), p_O.y(), options.height) + lever;
    return options.T_BS.inverse() * (T_OB.inverse() * p_F_O);
  }
};

TEST(WornCamera, IsAheadOfTheHeadWhereTheAhrsSaysThatItLooks) {
  const Situation now;
  WornCamera camera{HeadOptions{}};
  camera.add_ahrs(head(now.gaze_W - now.yaw_WA, now.pitch));
  camera.set_yaw_offset({now.yaw_WA, 0.01});
  camera.set_map_yaw(kNow, {now.yaw_OW, 0.01});
  const WearerPoseSample pose = camera.pose(kNow, now.p_O, 1e-4 * Eigen::Matrix2d::Identity(), now.T_OB);
  EXPECT_NEAR((pose.T_SF.T.p - now.truth_S({})).norm(), 0.0, 1e-9);
  EXPECT_FALSE(pose.has_orientation);
  EXPECT_TRUE(is_valid(pose.T_SF));
}

TEST(WornCamera, MayBeAnywhereAroundTheHeadWhenNobodySaysWhereItLooks) {
  const Situation now;
  const HeadOptions options;
  WornCamera camera{options};
  const WearerPoseSample pose = camera.pose(kNow, now.p_O, Eigen::Matrix2d::Zero(), now.T_OB);
  const Eigen::Vector3d error = pose.T_SF.T.p - now.truth_S(options);
  EXPECT_LT(error.norm(), 0.13);
  const Eigen::Matrix3d P = pose.T_SF.covariance.topLeftCorner<3, 3>();
  EXPECT_LT(error.dot(P.inverse() * error), 9.0);
  EXPECT_GT(std::sqrt(P(0, 0)), 0.07);
}

TEST(WornCamera, HasTheCovarianceOfItsErrors) {
  // Monte Carlo over everything that the covariance speaks of.
  const Situation now;
  const HeadOptions options;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  constexpr double kBody = 0.03, kYaw = 0.1;
  double sum = 0.0;
  constexpr int kDraws = 4000;
  for (int k = 0; k < kDraws; ++k) {
    Situation claimed = now;
    claimed.p_O += kBody * Eigen::Vector2d(normal(random), normal(random));
    claimed.yaw_WA += kYaw * normal(random);
    WornCamera camera{options};
    camera.add_ahrs(head(now.gaze_W - now.yaw_WA + 0.01 * normal(random), now.pitch));
    camera.set_yaw_offset({claimed.yaw_WA, kYaw});
    camera.set_map_yaw(kNow, {now.yaw_OW, 0.0});
    const auto pose = camera.pose(kNow, claimed.p_O, kBody * kBody * Eigen::Matrix2d::Identity(), now.T_OB);
    const Eigen::Vector3d tilt =
        options.tilt_sigma * Eigen::Vector3d(normal(random), normal(random), normal(random));
    const Eigen::Vector3d shift =
        turned(0.3).conjugate() * Eigen::Vector3d(options.sway_sigma * normal(random),
                                                  options.sway_sigma * normal(random),
                                                  options.height_sigma * normal(random));
    const Eigen::Vector3d truth =
        now.truth_S(options) + options.T_BS.q.conjugate() * shift + tilt.cross(now.truth_S(options));
    const Eigen::Vector3d error = pose.T_SF.T.p - truth;
    sum += error.dot(pose.T_SF.covariance.topLeftCorner<3, 3>().inverse() * error);
  }
  EXPECT_NEAR(sum / kDraws, 3.0, 0.15);
}

TEST(WornCamera, KnowsTheMapsYawForAWhileOnly) {
  WornCamera camera{HeadOptions{}};
  EXPECT_FALSE(camera.yaw_OW(kNow));
  camera.set_map_yaw(kNow, {0.3, 0.01});
  ASSERT_TRUE(camera.yaw_OW(kNow + kNanosecondsPerSecond));
  EXPECT_GT(camera.yaw_OW(kNow + kNanosecondsPerSecond)->sigma, 0.01);
  EXPECT_FALSE(camera.yaw_OW(kNow + 10 * kNanosecondsPerSecond));
}

TEST(WornCamera, RefusesOrientationsThatAreNoneOrOld) {
  WornCamera camera{HeadOptions{}};
  EXPECT_TRUE(camera.add_ahrs(head(0.1)));
  EXPECT_FALSE(camera.add_ahrs(head(0.1)));
  EXPECT_FALSE(camera.add_ahrs(head(0.1, 0.0, kNow - 1)));
  AhrsSample bad = head(0.1, 0.0, kNow + 1);
  bad.q_WH.coeffs() *= 2.0;
  EXPECT_FALSE(camera.add_ahrs(bad));
  bad.q_WH.coeffs().setConstant(std::nan(""));
  EXPECT_FALSE(camera.add_ahrs(bad));
}

}  // namespace
}  // namespace cosight::wearer
