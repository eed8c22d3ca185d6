#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/dense_filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {

inline Eigen::MatrixXd whole(const GaussianState& state) {
  return Eigen::MatrixXd(state.P_lower().selfadjointView<Eigen::Lower>());
}

/// Both filters side by side, with the same camera and landmarks.
class SideBySide : public testing::TestWithParam<unsigned> {
 protected:
  static FilterOptions options(unsigned seed) {
    FilterOptions o;
    o.point_form = seed % 2 == 0 ? PointForm::kInverseDistance : PointForm::kEuclidean;
    o.max_landmarks = 12;
    o.max_clones = 3;
    o.gate_probability = 1.0;
    o.motion = {0.5, 0.8};
    return o;
  }

  void SetUp() override {
    CameraState x = scene.camera_state();
    x.v_W *= 0.2;
    x.omega_S *= 0.2;
    Eigen::MatrixXd P = scene.covariance(CameraState::kDim, 0.02);
    filter.reset(x, P);
    dense.x = x.vector();
    dense.P = P;
    dense.normalise();
    // The reset takes the covariance as it is; carry it onto the unit quaternion as the dense one is.
    filter.reset(x, dense.P);
    rig.camera_S = camera;
    rig.camera_F = scene.camera();
    rig.sigma_pixel_F = 1.5;
    expect_same();
  }

  void expect_same(double tolerance = 2e-5) {
    ASSERT_EQ(filter.state().size(), dense.x.size());
    EXPECT_THAT(filter.state().x(), IsNearMatrix(dense.x, tolerance));
    const Eigen::VectorXd sigma = dense.P.diagonal().cwiseMax(1e-18).cwiseSqrt();
    const Eigen::MatrixXd scaled = sigma.cwiseInverse().asDiagonal() * (whole(filter.state()) - dense.P) *
                                   sigma.cwiseInverse().asDiagonal();
    EXPECT_LT(scaled.cwiseAbs().maxCoeff(), tolerance);
  }

  CameraState camera_of(const Eigen::VectorXd& x) const { return CameraState::from_vector(x.head<13>()); }

  /// A match in a free camera that looks at the same point, with its pose.
  StereoMatch new_match() {
    const Eigen::Vector3d p_S = scene.point_in_view(2.0, 6.0);
    rig.T_SF.T.p = Eigen::Vector3d(0.8, 0.1, 0.05);
    rig.T_SF.T.q = quaternion_exp({0.05, -0.2, 0.03});
    rig.T_SF = scene.uncertain_pose(rig.T_SF.T, 0.02, 0.01);
    return {*rig.camera_S.project(p_S) + Eigen::Vector2d(0.2, -0.3),
            *rig.camera_F.project(rig.T_SF.T.inverse() * p_S) + Eigen::Vector2d(-0.2, 0.4)};
  }

  /// d (4 pixels, dp, dtheta) -> y, written with the pose error in the axes of S.
  Eigen::VectorXd pseudo_stereo(const Eigen::VectorXd& x, const Eigen::VectorXd& noise,
                                const StereoMatch& match) const {
    const Pose T_SF{quaternion_exp(noise.tail<3>()) * rig.T_SF.T.q, rig.T_SF.T.p + noise.segment<3>(4)};
    const auto point = triangulate({match.pixel_S + noise.head<2>(), match.pixel_F + noise.segment<2>(2)},
                                   rig.camera_S, rig.camera_F, T_SF);
    return landmark_at(camera_of(x), point->ray_S, point->rho);
  }

  static Eigen::VectorXd landmark_at(const CameraState& x, const Eigen::Vector3d& ray_S, double rho) {
    const Eigen::Vector3d m = (x.q_WS.toRotationMatrix() * ray_S).normalized();
    Eigen::VectorXd y(6);
    y << x.r_WS, std::atan2(m.y(), m.x()), std::asin(m.z()), rho;
    return y;
  }

  Eigen::MatrixXd stereo_noise() const {
    Eigen::MatrixXd N = Eigen::MatrixXd::Zero(10, 10);
    N.diagonal().head<4>() << 1.0, 1.0, 2.25, 2.25;
    N.bottomRightCorner<6, 6>() = rig.T_SF.covariance;
    return N;
  }

  void add_both_ways(const StereoMatch& match) {
    const auto id = filter.add_pseudo_stereo_landmark(match, rig);
    ASSERT_TRUE(id);
    ids.push_back(*id);
    dense.augment(
        [&](const Eigen::VectorXd& x, const Eigen::VectorXd& n) { return pseudo_stereo(x, n, match); },
        stereo_noise(), 1e-5);
  }

  Eigen::VectorXd pixel_of(const Eigen::VectorXd& x, int offset) const {
    const CameraState c = camera_of(x);
    const Eigen::Vector3d m = ray_of_angles({x(offset + 3), x(offset + 4)});
    const Eigen::Vector3d h_W = x(offset + 5) * (x.segment<3>(offset) - c.r_WS) + m;
    return *camera.project(c.q_WS.toRotationMatrix().transpose() * h_W);
  }

  Eigen::VectorXd point_of(const Eigen::VectorXd& x, int offset) const {
    const CameraState c = camera_of(x);
    const Eigen::Vector3d m = ray_of_angles({x(offset + 3), x(offset + 4)});
    return c.q_WS.toRotationMatrix().transpose() * (x.segment<3>(offset) + m / x(offset + 5) - c.r_WS);
  }

  void predict_both(double dt) {
    filter.predict(dt);
    const auto move = [dt](const Eigen::VectorXd& x, const Eigen::VectorXd& impulse) {
      Eigen::VectorXd next = x;
      const Eigen::Vector3d v = x.segment<3>(7) + impulse.head<3>();
      const Eigen::Vector3d omega = x.segment<3>(10) + impulse.tail<3>();
      next.segment<3>(0) += v * dt;
      const Eigen::Quaterniond q(x(3), x(4), x(5), x(6));
      const double angle = omega.norm() * dt;
      const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, omega.normalized()));
      next.segment<4>(3) = wxyz(q * turn);
      next.segment<3>(7) = v;
      next.segment<3>(10) = omega;
      return next;
    };
    Eigen::VectorXd Q(6);
    Q << Eigen::VectorXd::Constant(3, std::pow(0.5 * dt, 2)),
        Eigen::VectorXd::Constant(3, std::pow(0.8 * dt, 2));
    const Eigen::VectorXd x_0 = dense.x;
    dense.predict([&](const Eigen::VectorXd& x) { return move(x, Eigen::VectorXd::Zero(6)); },
                  [&](const Eigen::VectorXd& i) { return move(x_0, i); }, Q.asDiagonal());
  }

  RandomScene scene{GetParam()};
  CameraModel camera = scene.camera();
  Filter filter{camera, options(GetParam())};
  DenseFilter dense;
  StereoRig rig;
  std::vector<LandmarkId> ids;
};

}  // namespace cosight::ekf
