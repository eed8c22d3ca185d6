// The error of T_SF as a state: the same as shared noise where it must be, and as far off as it says.
#include "robot_agent/ekf/rig_error.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "robot_agent/ekf/chi_squared.hpp"
#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kEta = RigError::kOffset;
constexpr int kDim = RigError::kDim;

MatrixXd whole(const GaussianState& state) {
  return MatrixXd(state.P_lower().selfadjointView<Eigen::Lower>());
}

FilterOptions with_state(double correlation_time = 0.0, double white_share = 0.0) {
  FilterOptions options;
  options.max_landmarks = 20;
  options.gate_probability = 1.0;
  options.rig_error = {true, correlation_time, white_share};
  return options;
}

class RigErrorState : public testing::TestWithParam<unsigned> {
 protected:
  RigErrorState() {
    rig.camera_S = camera;
    rig.camera_F = scene.camera();
    rig.T_SF = scene.uncertain_pose({quaternion_exp({0.05, -0.2, 0.03}), {0.8, 0.1, 0.05}}, 0.02, 0.01);
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
    T_WS.covariance = scene.covariance(6, 0.01);
  }

  /// Landmarks of both kinds that every filter starts in the same way.
  std::vector<LandmarkId> add_landmarks(Filter& filter) const {
    std::vector<LandmarkId> ids;
    for (const Vector3d& p_S : points) {
      const FirstSighting first{{{T_WS.T.q, T_WS.T.p + Vector3d(0.0, 0.4, 0.0)}, T_WS.covariance},
                                *camera.project(p_S + Vector3d(0.4, 0.0, 0.0))};
      const auto id = ids.size() % 2 == 0
                          ? filter.add_delayed_landmark(first, *camera.project(p_S))
                          : filter.add_known_point(T_WS.T * p_S, 1e-3 * Eigen::Matrix3d::Identity());
      if (id) ids.push_back(*id);
    }
    return ids;
  }

  RandomScene scene{GetParam()};
  CameraModel camera = scene.camera();
  StereoRig rig;
  UncertainPose T_WS;
  std::vector<Vector3d> points{{0.5, 0.2, 4.0}, {-0.7, 0.1, 5.0}, {0.1, -0.6, 3.0}, {-0.2, 0.4, 6.0}};
};

TEST_P(RigErrorState, MovesThePoseAsItsJacobianSays) {
  const RigErrorOptions options{true, 1.0, 0.3};
  const RigError::Vector eta = scene.normals(kDim);
  const CorrectedRig at = correct_rig(rig.T_SF, options, eta);
  const auto moved = [&](const VectorXd& changed) {
    const CorrectedRig other = correct_rig(rig.T_SF, options, changed);
    VectorXd d(6);
    d << other.T_SF.p - at.T_SF.p, quaternion_log(other.T_SF.q * at.T_SF.q.conjugate());
    return d;
  };
  EXPECT_THAT(at.by_eta, IsNearMatrix(numeric_jacobian(moved, eta), 1e-6));
  const CorrectedRig sensed = correct_rig(rig.T_SF, options, RigError::Vector::Zero());
  const MatrixXd sum =
      sensed.by_eta * sensed.by_eta.transpose() + sensed.noise_factor * sensed.noise_factor.transpose();
  EXPECT_THAT(sum, IsNearMatrix(MatrixXd(rig.T_SF.covariance), 1e-9));
}

/// To first order it is the same whether an error is estimated as well, or only counted as what the
/// measurements of the frame share.
TEST_P(RigErrorState, AWhiteErrorInTheStateIsSharedNoise) {
  FilterOptions shared = with_state();
  shared.rig_error.is_state = false;
  Filter noise(camera, shared);
  Filter state(camera, with_state(0.0, GetParam() % 2 == 0 ? 0.4 : 0.0));
  std::vector<Measurement> measurements;
  for (Filter* filter : {&noise, &state}) {
    filter->reset(T_WS, 0.3, 0.3);
    const std::vector<LandmarkId> ids = add_landmarks(*filter);
    ASSERT_GE(ids.size(), 3U);
    filter->predict(0.1);
    for (std::size_t i = 0; measurements.size() < 2 * ids.size(); ++i) {
      const Vector3d p_S = filter->predict_point(ids[i])->p_S;
      const Vector2d pixel_S = *camera.project(p_S) + scene.normals(2);
      const Vector2d pixel_F = *rig.camera_F.project(rig.T_SF.T.inverse() * p_S) + 5.0 * scene.normals(2);
      measurements.push_back(Measurement::pixel(ids[i], pixel_S, 1.0));
      measurements.push_back(Measurement::wearer_pixel(ids[i], pixel_F, 1.0));
    }
    ASSERT_EQ(filter->update(measurements, &rig).fused, static_cast<int>(measurements.size()));
  }
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < state.state().size(); ++i) {
    if (i < kEta || i >= kEta + kDim) others.push_back(i);
  }
  EXPECT_THAT(VectorXd(VectorXd(state.state().x())(others)), IsNearMatrix(VectorXd(noise.state().x()), 1e-7));
  EXPECT_THAT(MatrixXd(whole(state.state())(others, others)), IsNearMatrix(whole(noise.state()), 1e-6));
  EXPECT_GT(VectorXd(state.state().x().segment<kDim>(kEta)).norm(), 0.01);
}

TEST_P(RigErrorState, IsForgottenAsItsCorrelationTimeSays) {
  constexpr double kTime = 2.0;
  constexpr double kDt = 0.5;
  const double phi = std::exp(-kDt / kTime);
  Filter filter(camera, with_state(kTime));
  Filter white(camera, with_state());
  for (Filter* each : {&filter, &white}) {
    each->reset(T_WS, 0.3, 0.3);
    std::vector<StereoMatch> matches;
    for (const Vector3d& p_S : points)
      matches.push_back({*camera.project(p_S), *rig.camera_F.project(rig.T_SF.T.inverse() * p_S)});
    each->add_pseudo_stereo_landmarks(matches, rig);
  }
  const VectorXd x = filter.state().x();
  const MatrixXd P = whole(filter.state());
  filter.predict(kDt);
  white.predict(kDt);
  const MatrixXd after = whole(filter.state());
  const Eigen::Index behind = x.size() - kEta - kDim;
  EXPECT_THAT(filter.state().x().segment(kEta, kDim),
              IsNearMatrix(VectorXd(phi * x.segment(kEta, kDim)), 1e-12));
  EXPECT_THAT(after.block(kEta, kEta, kDim, kDim),
              IsNearMatrix(MatrixXd(phi * phi * P.block(kEta, kEta, kDim, kDim) +
                                    (1.0 - phi * phi) * MatrixXd::Identity(kDim, kDim)),
                           1e-12));
  EXPECT_THAT(after.block(kEta + kDim, kEta, behind, kDim),
              IsNearMatrix(MatrixXd(phi * P.block(kEta + kDim, kEta, behind, kDim)), 1e-12));
  EXPECT_THAT(after.block(kEta, 7, kDim, 6), IsNearMatrix(MatrixXd(phi * P.block(kEta, 7, kDim, 6)), 1e-9));
  EXPECT_EQ(after.bottomRightCorner(behind, behind), P.bottomRightCorner(behind, behind));
  EXPECT_EQ(whole(white.state()).block(kEta, 0, kDim, kEta), MatrixXd::Zero(kDim, kEta));
  EXPECT_EQ(VectorXd(white.state().x().segment<kDim>(kEta)), VectorXd::Zero(kDim));
}

/// Landmarks of one frame, and the error of T_SF, against truth drawn from what the filter is told.
TEST(RigErrorStart, StatesItsOwnErrorAndFindsTheTurnOfTheFreeCamera) {
  constexpr int kRuns = 100;
  constexpr int kPoints = 12;
  RandomScene scene(3);
  double nees = 0.0;
  double turned_before = 0.0;
  double turned_after = 0.0;
  int dof = 0;
  for (int run = 0; run < kRuns; ++run) {
    StereoRig rig;
    rig.T_SF.T = {quaternion_exp({0.05, -0.2, 0.03}), {1.0, 0.1, 0.05}};
    rig.T_SF.covariance.diagonal() << Vector3d::Constant(4e-4), Vector3d::Constant(4e-4);  // 2 cm, 1.1 deg
    const Pose T_SF{quaternion_exp(0.02 * scene.normals(3)) * rig.T_SF.T.q,
                    rig.T_SF.T.p + 0.02 * scene.normals(3)};
    RigError::Vector eta;
    eta << (T_SF.p - rig.T_SF.T.p) / 0.02, quaternion_log(T_SF.q * rig.T_SF.T.q.conjugate()) / 0.02;
    Filter filter(rig.camera_S, with_state());
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
    filter.reset(T_WS, 0.1, 0.1);
    std::vector<StereoMatch> matches;
    std::vector<Vector3d> truth;  // theta, phi, rho
    while (static_cast<int>(matches.size()) < kPoints) {
      const Vector3d p_S = scene.point_in_view(3.0, 6.0);
      const auto pixel_F = rig.camera_F.project(T_SF.inverse() * p_S);
      if (!pixel_F) continue;
      const auto angles = angles_of_ray(T_WS.T.q * p_S);
      truth.emplace_back(angles->theta, angles->phi, 1.0 / p_S.norm());
      matches.push_back(
          {*rig.camera_S.project(p_S) + Vector2d(scene.normals(2)), *pixel_F + Vector2d(scene.normals(2))});
    }
    const auto ids = filter.add_pseudo_stereo_landmarks(matches, rig);
    std::vector<Eigen::Index> rows{13, 14, 15, 16, 17, 18};
    VectorXd error(kDim + 3 * kPoints);
    error.head<kDim>() = eta - filter.state().x().segment<kDim>(kEta);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      ASSERT_TRUE(ids[i]);
      const int at = filter.landmark_offset(*ids[i]) + InverseDepthPoint::kTheta;
      error.segment<3>(kDim + 3 * static_cast<Eigen::Index>(i)) =
          truth[i] - filter.state().x().segment<3>(at);
      rows.insert(rows.end(), {at, at + 1, at + 2});
    }
    nees += error.dot(MatrixXd(whole(filter.state())(rows, rows)).llt().solve(error));
    dof += static_cast<int>(error.size());
    turned_before += eta.tail<3>().squaredNorm();
    turned_after += error.segment<3>(3).squaredNorm();
    const UncertainPose corrected = filter.corrected_T_SF(rig.T_SF);
    EXPECT_LT(corrected.covariance(3, 3), 0.1 * rig.T_SF.covariance(3, 3));  // across the baseline
  }
  EXPECT_GT(nees, chi_squared_quantile(0.01, dof));
  EXPECT_LT(nees, chi_squared_quantile(0.99, dof));
  EXPECT_LT(turned_after, 0.3 * turned_before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RigErrorState, testing::Range(1U, 11U));

}  // namespace
}  // namespace cosight::ekf
