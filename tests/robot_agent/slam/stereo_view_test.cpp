#include "robot_agent/slam/stereo_view.hpp"

#include <gtest/gtest.h>

#include <random>

#include "robot_agent/slam/stopwatch.hpp"
#include "robot_agent/slam/wearer_silhouette.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::slam {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Looks along x of W, level.
Pose level_camera(const Eigen::Vector3d& p_W) {
  return {Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), p_W};
}

UncertainPose robot_pose() {
  UncertainPose T_WS;
  T_WS.T = {quaternion_exp({0.1, -0.2, 0.7}) * level_camera({}).q, {1.0, 2.0, 0.8}};
  T_WS.covariance.diagonal() << 1e-4, 2e-4, 3e-4, 4e-6, 9e-6, 2.5e-5;
  return T_WS;
}

WearerView ahrs_view(const UncertainPose& T_WS, const Pose& T_SF) {
  WearerView view;
  view.has_orientation = false;
  view.T_SF.T.p = T_SF.p;
  view.T_SF.covariance.diagonal().head<3>() << 1e-4, 4e-4, 9e-4;
  view.q_WF = T_WS.T.q * T_SF.q;
  view.q_WF_covariance.diagonal() << 1e-5, 4e-6, 3e-5;
  return view;
}

Eigen::Matrix3d root(const Eigen::Matrix3d& covariance) {
  return covariance.llt().matrixL();
}

TEST(WearerPose, IsThePoseThatWasGivenWhenItHasAnOrientation) {
  WearerView view;
  view.T_SF.T = {quaternion_exp({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0}};
  view.T_SF.covariance.diagonal() << 1, 2, 3, 4, 5, 6;
  view.q_WF = Eigen::Quaterniond(0, 1, 0, 0);  // not looked at
  const auto T_SF = wearer_pose(view, robot_pose());
  ASSERT_TRUE(T_SF);
  EXPECT_EQ(T_SF->T.q.coeffs(), view.T_SF.T.q.coeffs());
  EXPECT_EQ(T_SF->covariance, view.T_SF.covariance);
}

TEST(WearerPose, TurnsTheAhrsByItsYawOffset) {
  const UncertainPose T_WS = robot_pose();
  const Pose T_SF{quaternion_exp({0.1, -0.2, 0.3}), {-0.5, 0.1, 1.2}};
  WearerView view = ahrs_view(T_WS, T_SF);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  view.q_WF = turn.conjugate() * *view.q_WF;
  const auto turned = wearer_pose(view, T_WS, {0.3, 0.02});
  ASSERT_TRUE(turned);
  EXPECT_LT(turned->T.q.angularDistance(T_SF.q), 1e-9);
  const Eigen::Vector3d z_S = T_WS.T.q.conjugate() * Eigen::Vector3d::UnitZ();
  const auto sure = wearer_pose(view, T_WS, {0.3, 0.0});
  const Eigen::Matrix3d added = (turned->covariance - sure->covariance).bottomRightCorner<3, 3>();
  EXPECT_TRUE(added.isApprox(4e-4 * z_S * z_S.transpose(), 1e-9));
}

TEST(WearerPose, IsNothingWithoutAnyOrientation) {
  WearerView view;
  view.has_orientation = false;
  EXPECT_FALSE(wearer_pose(view, robot_pose()));
}

TEST(WearerPose, TakesTheOrientationFromTheAhrsInTheAxesOfTheSlamCamera) {
  const Pose T_SF{quaternion_exp({-0.3, 0.4, 0.1}), {0.4, -0.2, 1.5}};
  const auto found = wearer_pose(ahrs_view(robot_pose(), T_SF), robot_pose());
  ASSERT_TRUE(found);
  EXPECT_LT(found->T.q.angularDistance(T_SF.q), 1e-9);
  EXPECT_EQ(found->T.p, T_SF.p);
  EXPECT_TRUE(is_valid(*found));
}

TEST(WearerPose, AdmitsTheErrorsOfBothOrientationsAsAMonteCarloSeesThem) {
  const UncertainPose T_WS = robot_pose();
  const WearerView view = ahrs_view(T_WS, {quaternion_exp({-0.3, 0.4, 0.1}), {0.4, -0.2, 1.5}});
  const auto T_SF = wearer_pose(view, T_WS);
  ASSERT_TRUE(T_SF);
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  const auto draw = [&](const Eigen::Matrix3d& covariance) {
    const Eigen::Vector3d deviates(normal(random), normal(random), normal(random));
    return Eigen::Vector3d(root(covariance) * deviates);
  };
  Matrix6d sum = Matrix6d::Zero();
  constexpr int kDraws = 40'000;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::Quaterniond q_WS =
        quaternion_exp(draw(T_WS.covariance.bottomRightCorner<3, 3>())) * T_WS.T.q;
    const Eigen::Quaterniond q_WF = quaternion_exp(draw(view.q_WF_covariance)) * *view.q_WF;
    Vector6d error;
    error << draw(view.T_SF.covariance.topLeftCorner<3, 3>()),
        quaternion_log(q_WS.conjugate() * q_WF * T_SF->T.q.conjugate());
    sum += error * error.transpose();
  }
  const Matrix6d sampled = sum / kDraws;
  const Vector6d sigma = sampled.diagonal().cwiseSqrt();
  const Matrix6d difference =
      (T_SF->covariance - sampled).cwiseQuotient(sigma * sigma.transpose());  // as correlations
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.03) << difference;
}

class Silhouette : public testing::Test {
 protected:
  CameraModel camera_{.fx = 300, .fy = 300, .cx = 319.5, .cy = 239.5, .width = 640, .height = 480};
  Pose T_WS_ = level_camera({1.0, -2.0, 1.0});
  BodyOptions body_;
};

TEST_F(Silhouette, CoversTheBodyThatIsInTheImage) {
  const Pose T_SF{Eigen::Quaterniond::Identity(), {0.3, -0.6, 4.0}};  // 0.6 m above Cs
  const ConvexPolygon silhouette = wearer_silhouette(camera_, T_WS_, T_SF, body_);
  ASSERT_GE(silhouette.size(), 3U);
  // In S: y down. Eyes at y = -0.6, head to -0.85, feet to 1.15; as wide as the arms.
  for (const double across : {-0.42, 0.0, 0.42}) {
    for (const double down : {-0.83, -0.6, 0.0, 0.6, 1.13}) {
      const auto pixel = camera_.project({0.3 + across, down, 4.0});
      ASSERT_TRUE(pixel);
      EXPECT_TRUE(contains(silhouette, *pixel)) << pixel->transpose();
    }
  }
  EXPECT_FALSE(contains(silhouette, *camera_.project({0.3 + 0.6, 0.0, 4.0})));
  EXPECT_FALSE(contains(silhouette, *camera_.project({0.3, -1.0, 4.0})));
}

TEST_F(Silhouette, StaysUprightWhenTheCameraRolls) {
  T_WS_.q = T_WS_.q * quaternion_exp({0.0, 0.0, 0.5});  // about the optical axis
  const Eigen::Vector3d eyes_W(5.0, -2.0, 1.6);
  const Pose T_SF{Eigen::Quaterniond::Identity(), T_WS_.inverse() * eyes_W};
  const ConvexPolygon silhouette = wearer_silhouette(camera_, T_WS_, T_SF, body_);
  for (const double down : {0.0, 0.8, 1.6}) {
    const auto pixel = camera_.project(T_WS_.inverse() * (eyes_W - down * Eigen::Vector3d::UnitZ()));
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(contains(silhouette, *pixel)) << down;
  }
}

TEST_F(Silhouette, IsEmptyBehindBesideTooNearOrWithoutABody) {
  EXPECT_TRUE(wearer_silhouette(camera_, T_WS_, {{}, {0.0, 0.0, -3.0}}, body_).empty());
  EXPECT_TRUE(wearer_silhouette(camera_, T_WS_, {{}, {0.0, 0.0, 0.5}}, body_).empty());
  EXPECT_TRUE(wearer_silhouette(camera_, T_WS_, {{}, {9.0, 0.0, 2.0}}, body_).empty());
  body_.radius = 0.0;
  EXPECT_TRUE(wearer_silhouette(camera_, T_WS_, {{}, {0.0, 0.0, 4.0}}, body_).empty());
}

TEST_F(Silhouette, NeverLeavesTheImage) {
  const ConvexPolygon silhouette = wearer_silhouette(camera_, T_WS_, {{}, {0.2, -0.5, 0.9}}, body_);
  ASSERT_FALSE(silhouette.empty());
  for (const Eigen::Vector2d& corner : silhouette)
    EXPECT_TRUE(camera_.contains(corner, -1e-9)) << corner.transpose();
}

TEST(Stopwatch, WithoutAClockEveryLapIsZero) {
  const Stopwatch::Clock none;
  Stopwatch watch(none);
  double stage = 0.0;
  watch.lap(stage);
  EXPECT_EQ(stage, 0.0);
  EXPECT_EQ(watch.total(), 0.0);
}

TEST(Stopwatch, AddsItsLapsInMilliseconds) {
  Stamp now = 0;
  const Stopwatch::Clock clock = [&now] { return now; };
  Stopwatch watch(clock);
  double first = 0.5;
  double second = 0.0;
  now = 2'000'000;
  watch.lap(first);
  now = 5'000'000;
  watch.lap(second);
  EXPECT_DOUBLE_EQ(first, 2.5);
  EXPECT_DOUBLE_EQ(second, 3.0);
  EXPECT_DOUBLE_EQ(watch.total(), 5.0);
}

}  // namespace
}  // namespace cosight::slam
