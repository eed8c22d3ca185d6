#pragma once

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <random>

#include "robot_agent/ekf/camera_state.hpp"
#include "robot_agent/ekf/inverse_depth_point.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/rotation.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::ekf {

/// Random states, cameras and landmarks; every draw from one seed.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : rng_(seed) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(rng_); }
  double normal() { return normal_(rng_); }
  Eigen::VectorXd normals(int n) {
    Eigen::VectorXd v(n);
    for (int i = 0; i < n; ++i)
      v(i) = normal();
    return v;
  }

  /// Any rotation; one in four within 1e-3 rad of a half turn.
  Eigen::Quaterniond rotation() {
    const Eigen::Vector3d axis = Eigen::Vector3d(normals(3)).normalized();
    const bool half_turn = uniform(0.0, 1.0) < 0.25;
    return quaternion_exp(axis * (half_turn ? 3.14159265 + uniform(-1e-3, 1e-3) : uniform(0.0, 3.1)));
  }

  CameraState camera_state() {
    CameraState x;
    x.r_WS = normals(3);
    x.q_WS = rotation();
    x.v_W = normals(3);
    x.omega_S = normals(3);
    return x;
  }

  CameraModel camera() {
    CameraModel camera{.fx = 458.0, .fy = 457.0, .cx = 367.0, .cy = 248.0, .width = 752, .height = 480};
    switch (std::uniform_int_distribution<int>(0, 2)(rng_)) {
      case 0:
        break;
      case 1:
        camera.distortion = Distortion::kRadtan;
        camera.coefficients = {-0.28, 0.074, 1.9e-4, 1.8e-5, 0.0};
        break;
      default:
        camera.distortion = Distortion::kEquidistant;
        camera.coefficients = {-0.01, 0.02, -0.01, 0.002, 0.0};
    }
    return camera;
  }

  /// A point of the camera's own frame inside the field of view.
  Eigen::Vector3d point_in_view(double min_depth, double max_depth) {
    return uniform(min_depth, max_depth) * Eigen::Vector3d(uniform(-0.5, 0.5), uniform(-0.35, 0.35), 1.0);
  }

  /// A landmark of the given inverse depth that `x` sees, first seen from nearby.
  InverseDepthPoint landmark_in_view(const CameraState& x, double rho) {
    InverseDepthPoint y;
    const Eigen::Vector3d ray_W = x.q_WS * point_in_view(1.0, 1.0);
    const auto angles = angles_of_ray(ray_W);
    y.anchor_W = x.r_WS + 0.1 * Eigen::Vector3d(normals(3));
    y.theta = angles->theta;
    y.phi = angles->phi;
    y.rho = rho;
    return y;
  }

  /// Positive definite with standard deviations about `scale`.
  Eigen::MatrixXd covariance(int n, double scale) {
    Eigen::MatrixXd A(n, n);
    for (int i = 0; i < n * n; ++i)
      A.data()[i] = normal();
    return scale * scale * (A * A.transpose() / n + 0.1 * Eigen::MatrixXd::Identity(n, n));
  }

  UncertainPose uncertain_pose(const Pose& T, double sigma_p, double sigma_theta) {
    UncertainPose pose{T, covariance(6, 1.0)};
    Eigen::Matrix<double, 6, 1> scale;
    scale << sigma_p, sigma_p, sigma_p, sigma_theta, sigma_theta, sigma_theta;
    pose.covariance = (scale.asDiagonal() * pose.covariance * scale.asDiagonal()).eval();
    return pose;
  }

  std::mt19937& rng() { return rng_; }

 private:
  std::mt19937 rng_;
  std::normal_distribution<double> normal_;
};

/// Central differences of f: R^n -> R^m at x.
template <class Function>
Eigen::MatrixXd numeric_jacobian(const Function& f, const Eigen::VectorXd& x, double step = 1e-6) {
  const Eigen::VectorXd f_0 = f(x);
  Eigen::MatrixXd J(f_0.size(), x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::VectorXd plus = x;
    Eigen::VectorXd minus = x;
    plus(i) += step;
    minus(i) -= step;
    J.col(i) = (f(plus) - f(minus)) / (plus(i) - minus(i));
  }
  return J;
}

/// Entries within `tolerance` of the largest entry of their row (rows may have different units); prints the
/// worst.
MATCHER_P2(IsNearMatrix, expected, tolerance, "") {
  const Eigen::MatrixXd want = expected;
  const Eigen::MatrixXd got = arg;
  if (want.rows() != got.rows() || want.cols() != got.cols()) {
    *result_listener << "is " << got.rows() << "x" << got.cols() << ", not " << want.rows() << "x"
                     << want.cols();
    return false;
  }
  double worst = 0.0;
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < want.rows(); ++i) {
    const double scale = 1e-9 + want.row(i).cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < want.cols(); ++j) {
      const double error = std::abs(want(i, j) - got(i, j)) / scale;
      if (error <= worst) continue;
      worst = error;
      row = i;
      column = j;
    }
  }
  *result_listener << "worst entry (" << row << ", " << column << "): " << got(row, column) << ", expected "
                   << want(row, column) << ", " << worst << " of its row";
  return worst <= tolerance && got.allFinite();
}

}  // namespace cosight::ekf
