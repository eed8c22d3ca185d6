#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <functional>
#include <vector>

#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {

/// The textbook EKF: both triangles, numeric Jacobians, explicit inverse. Slow and plain.
struct DenseFilter {
  Eigen::VectorXd x;
  Eigen::MatrixXd P;

  using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

  void predict(const Function& f, const Function& f_of_impulse, const Eigen::MatrixXd& Q) {
    const Eigen::MatrixXd F = numeric_jacobian(f, x);
    const Eigen::MatrixXd G = numeric_jacobian(f_of_impulse, Eigen::VectorXd::Zero(Q.rows()));
    x = f(x);
    P = (F * P * F.transpose() + G * Q * G.transpose()).eval();
  }

  void update(const Function& h, const Eigen::VectorXd& z, const Eigen::MatrixXd& R) {
    const Eigen::MatrixXd H = numeric_jacobian(h, x);
    const Eigen::MatrixXd S = H * P * H.transpose() + R;
    const Eigen::MatrixXd K = P * H.transpose() * S.inverse();
    x += K * (z - h(x));
    P -= K * S * K.transpose();
    normalise();
  }

  /// x becomes [x, y(x, n)], n ~ N(0, N).
  void augment(const std::function<Eigen::VectorXd(const Eigen::VectorXd&, const Eigen::VectorXd&)>& y,
               const Eigen::MatrixXd& N, double noise_step) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(N.rows());
    const Eigen::MatrixXd Y_x = numeric_jacobian([&](const Eigen::VectorXd& v) { return y(v, zero); }, x);
    const Eigen::MatrixXd Y_n =
        numeric_jacobian([&](const Eigen::VectorXd& n) { return y(x, n); }, zero, noise_step);
    const Eigen::VectorXd y_0 = y(x, zero);
    const Eigen::Index n = x.size();
    const Eigen::Index k = y_0.size();
    Eigen::MatrixXd grown(n + k, n + k);
    grown << P, P * Y_x.transpose(), Y_x * P, Y_x * P * Y_x.transpose() + Y_n * N * Y_n.transpose();
    P = grown;
    x.conservativeResize(n + k);
    x.tail(k) = y_0;
  }

  void normalise() {
    const Function unit = [](const Eigen::VectorXd& v) {
      Eigen::VectorXd u = v;
      u.segment<4>(3).normalize();
      return u;
    };
    const Eigen::MatrixXd N = numeric_jacobian(unit, x);
    x = unit(x);
    P = (N * P * N.transpose()).eval();
  }
};

}  // namespace cosight::ekf
