// New landmarks against sampling: their covariance, and the covariance with all that they come from.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

CameraModel pinhole() {
  return {.fx = 450.0, .fy = 450.0, .cx = 320.0, .cy = 240.0, .width = 640, .height = 480};
}

/// Where the ray through `pixel` comes nearest to the other ray: midpoint triangulation, by its inverse
/// distance from the first centre. Not how the filter does it.
double sampled_inverse_depth(const Vector3d& h, const Vector3d& other, const Vector3d& other_centre) {
  // Distance along h of the point whose direction from the other centre is nearest to `other` in the plane of
  // h and the baseline: the same plane in which the law of sines holds.
  const Vector3d u = h.normalized();
  const Vector3d w = other.normalized();
  const double a = u.dot(w);
  const double d = u.dot(other_centre);
  const double e = w.dot(other_centre);
  return (1.0 - a * a) / (d - a * e);
}

VectorXd landmark_of(const Vector3d& r, const Vector3d& ray_W, double rho) {
  VectorXd y(6);
  const Vector3d m = ray_W.normalized();
  y << r, std::atan2(m.y(), m.x()), std::asin(m.z()), rho;
  return y;
}

/// Sample covariance of rows of draws.
MatrixXd covariance_of(const std::vector<VectorXd>& draws) {
  VectorXd mean = VectorXd::Zero(draws.front().size());
  for (const VectorXd& d : draws)
    mean += d / static_cast<double>(draws.size());
  MatrixXd C = MatrixXd::Zero(mean.size(), mean.size());
  for (const VectorXd& d : draws)
    C += (d - mean) * (d - mean).transpose() / static_cast<double>(draws.size());
  return C;
}

/// Largest difference in correlation units.
double difference(const MatrixXd& got, const MatrixXd& want) {
  const VectorXd s = want.diagonal().cwiseSqrt();
  return (s.cwiseInverse().asDiagonal() * (got - want) * s.cwiseInverse().asDiagonal()).cwiseAbs().maxCoeff();
}

class Initialisation : public testing::TestWithParam<unsigned> {
 protected:
  Initialisation() {
    FilterOptions options;
    options.max_landmarks = 4;
    filter = std::make_unique<Filter>(pinhole(), options);
    T_WS = scene.uncertain_pose({scene.rotation(), scene.normals(3)}, 0.01, 0.004);
    filter->reset(T_WS, 0.1, 0.1);
    L_pose = T_WS.covariance.llt().matrixL();
  }
  Pose draw_pose(const UncertainPose& pose, const Eigen::Matrix<double, 6, 6>& L) {
    const VectorXd e = L * scene.normals(6);
    const Vector3d turn = e.tail<3>();
    return {Eigen::AngleAxisd(turn.norm(), turn.normalized()) * pose.T.q, pose.T.p + e.head<3>()};
  }
  static Vector3d ray(const Vector2d& pixel) {
    return {(pixel.x() - 320.0) / 450.0, (pixel.y() - 240.0) / 450.0, 1.0};
  }
  Vector2d noise() { return {scene.normal(), scene.normal()}; }

  static constexpr int kDraws = 20'000;
  static constexpr double kTolerance = 0.06;  // of a correlation; sampling alone leaves 0.02
  RandomScene scene{GetParam()};
  std::unique_ptr<Filter> filter;
  UncertainPose T_WS;
  Eigen::Matrix<double, 6, 6> L_pose;
};

TEST_P(Initialisation, PseudoStereoCovarianceIsThatOfSamples) {
  StereoRig rig{pinhole(), pinhole(), {}, 0.5, 0.8};
  rig.T_SF =
      scene.uncertain_pose({quaternion_exp({0.05, -0.25, 0.02}), Vector3d(0.9, 0.1, 0.05)}, 0.005, 0.002);
  const Eigen::Matrix<double, 6, 6> L_rig = rig.T_SF.covariance.llt().matrixL();
  std::vector<StereoMatch> matches;
  for (int i = 0; i < 2; ++i) {
    const Vector3d p_S = scene.point_in_view(2.0, 3.5);
    matches.push_back({*rig.camera_S.project(p_S), *rig.camera_F.project(rig.T_SF.T.inverse() * p_S)});
  }
  const auto ids = filter->add_pseudo_stereo_landmarks(matches, rig);
  ASSERT_TRUE(ids[0] && ids[1]);
  std::vector<VectorXd> draws;
  for (int n = 0; n < kDraws; ++n) {
    const Pose pose = draw_pose(T_WS, L_pose);
    const Pose T_SF = draw_pose(rig.T_SF, L_rig);  // one for both landmarks
    VectorXd both(12);
    for (int i = 0; i < 2; ++i) {
      const Vector3d h = ray(matches[static_cast<std::size_t>(i)].pixel_S + 0.5 * noise());
      const Vector3d other = T_SF.q * ray(matches[static_cast<std::size_t>(i)].pixel_F + 0.8 * noise());
      both.segment<6>(6 * i) = landmark_of(pose.p, pose.q * h, sampled_inverse_depth(h, other, T_SF.p));
    }
    draws.push_back(both);
  }
  MatrixXd P = filter->state().P_lower().bottomRightCorner(12, 12).selfadjointView<Eigen::Lower>();
  EXPECT_LT(difference(P, covariance_of(draws)), kTolerance);
}

TEST_P(Initialisation, DelayedCovarianceIsThatOfSamples) {
  const Vector3d p_S = scene.point_in_view(2.0, 3.5);
  const Vector3d p_W = T_WS.T * p_S;
  FirstSighting first;
  first.T_WS.T = T_WS.T * Pose{quaternion_exp({0.01, -0.1, 0.0}), Vector3d(0.7, 0.05, 0.1)};
  first.T_WS = scene.uncertain_pose(first.T_WS.T, 0.008, 0.003);
  const Eigen::Matrix<double, 6, 6> L_first = first.T_WS.covariance.llt().matrixL();
  const auto first_pixel = pinhole().project(first.T_WS.T.inverse() * p_W);
  ASSERT_TRUE(first_pixel);
  first.pixel = *first_pixel;
  const Vector2d pixel_now = *pinhole().project(p_S);
  ASSERT_TRUE(filter->add_delayed_landmark(first, pixel_now));
  std::vector<VectorXd> draws;
  for (int n = 0; n < kDraws; ++n) {
    const Pose now = draw_pose(T_WS, L_pose);
    const Pose then = draw_pose(first.T_WS, L_first);
    const Vector3d h = now.q * ray(pixel_now + noise());
    const Vector3d other = then.q * ray(first.pixel + noise());
    draws.push_back(landmark_of(now.p, h, sampled_inverse_depth(h, other, then.p - now.p)));
  }
  const MatrixXd P = filter->state().P_lower().bottomRightCorner(6, 6).selfadjointView<Eigen::Lower>();
  EXPECT_LT(difference(P, covariance_of(draws)), kTolerance);
}

TEST_P(Initialisation, AnAssumedDepthStandsAtThePixelWithTheDoubtThatIsGiven) {
  const Vector2d pixel(300.0, 200.0);
  const auto id = filter->add_landmark_at_depth(pixel, 4.0, 0.5);
  ASSERT_TRUE(id);
  const auto landmark = filter->landmark(*id);
  EXPECT_NEAR(landmark->y.rho, 0.25, 1e-12);
  EXPECT_NEAR(landmark->sigma_rho, 0.125, 1e-12);
  const auto predicted = filter->predict_pixel(*id);
  ASSERT_TRUE(predicted);
  EXPECT_LT((predicted->pixel - pixel).norm(), 1e-6);
  // Its ray came from this very camera, whose own error cancels: what is left is the noise of two pixels.
  const double variance = 2.0 * filter->options().pixel_sigma * filter->options().pixel_sigma;
  EXPECT_LT((predicted->S - variance * Eigen::Matrix2d::Identity()).norm(), 1e-3 * variance);
}

TEST_P(Initialisation, KnownPointsMayBeExact) {
  const Vector3d p_W = T_WS.T * Vector3d(0.1, 0.2, 2.0);
  const auto id = filter->add_known_point(p_W, Eigen::Matrix3d::Zero());
  ASSERT_TRUE(id);
  const auto predicted = filter->predict_pixel(*id);
  ASSERT_TRUE(predicted);
  const double before = filter->camera_covariance().trace();
  for (int i = 0; i < 5; ++i) {
    const std::array<Measurement, 1> measured{Measurement::pixel(*id, predicted->pixel, 1.0)};
    EXPECT_EQ(filter->update(measured).fused, 1);
  }
  EXPECT_LT(filter->camera_covariance().trace(), before);
  EXPECT_EQ(filter->landmark(*id)->p_W, p_W);
  EXPECT_EQ(filter->landmark(*id)->p_W_covariance.norm(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Initialisation, testing::Range(1U, 7U));

TEST(FilterBudget, RefusesMoreThanItHasRoomFor) {
  FilterOptions options;
  options.max_landmarks = 2;
  options.max_clones = 1;
  Filter filter(pinhole(), options);
  EXPECT_TRUE(filter.add_known_point(Vector3d(0.0, 0.0, 3.0), Eigen::Matrix3d::Identity()));
  EXPECT_TRUE(filter.add_known_point(Vector3d(1.0, 0.0, 3.0), Eigen::Matrix3d::Identity()));
  EXPECT_FALSE(filter.has_room());
  EXPECT_FALSE(filter.add_known_point(Vector3d(0.0, 1.0, 3.0), Eigen::Matrix3d::Identity()));
  const auto clone = filter.clone_camera_pose();
  EXPECT_TRUE(clone);
  EXPECT_FALSE(filter.clone_camera_pose());
  filter.drop_clone(*clone);
  EXPECT_TRUE(filter.clone_camera_pose());
}

}  // namespace
}  // namespace cosight::ekf
