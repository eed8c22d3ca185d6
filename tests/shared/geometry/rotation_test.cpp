#include "shared/geometry/rotation.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace cosight {
namespace {

Eigen::Vector3d random_vector(std::mt19937& rng, double scale) {
  std::normal_distribution<double> normal(0.0, scale);
  return {normal(rng), normal(rng), normal(rng)};
}

class RotationSeed : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 rng_{GetParam()};
};

TEST_P(RotationSeed, ExponentialAgreesWithEigensAngleAxis) {
  const Eigen::Vector3d phi = random_vector(rng_, 1.0);
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(phi.norm(), phi.normalized()));
  EXPECT_LT(quaternion_exp(phi).angularDistance(expected), 1e-12);
}

TEST_P(RotationSeed, LogarithmUndoesTheExponentialUpToPi) {
  const Eigen::Vector3d axis = random_vector(rng_, 1.0).normalized();
  for (const double angle : {0.0, 1e-12, 1e-5, 0.3, 3.0, std::numbers::pi - 1e-9}) {
    EXPECT_LT((quaternion_log(quaternion_exp(angle * axis)) - angle * axis).norm(), 1e-8) << angle;
  }
}

template <int Rows, int Cols, typename F>
Eigen::Matrix<double, Rows, Cols> central_differences(const F& f, const Eigen::Matrix<double, Cols, 1>& x) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, Rows, Cols> J;
  for (int i = 0; i < Cols; ++i) {
    Eigen::Matrix<double, Cols, 1> plus = x;
    Eigen::Matrix<double, Cols, 1> minus = x;
    plus(i) += kStep;
    minus(i) -= kStep;
    J.col(i) = (f(plus) - f(minus)) / (2.0 * kStep);
  }
  return J;
}

TEST_P(RotationSeed, JacobiansMatchCentralDifferences) {
  const Eigen::Vector3d phi = random_vector(rng_, 1.0);
  const Eigen::Vector3d a = random_vector(rng_, 2.0);
  const Eigen::Quaterniond q = quaternion_exp(random_vector(rng_, 2.0));
  const Eigen::Vector4d q_vec = wxyz(q);
  const auto rotate = [&](const Eigen::Vector4d& v) -> Eigen::Vector3d {
    return from_wxyz(v).toRotationMatrix() * a;
  };
  const auto rotate_back = [&](const Eigen::Vector4d& v) -> Eigen::Vector3d {
    return from_wxyz(v).toRotationMatrix().transpose() * a;
  };
  EXPECT_LT((rotated_point_jacobian(q, a) - central_differences<3, 4>(rotate, q_vec)).cwiseAbs().maxCoeff(),
            1e-7);
  EXPECT_LT((inverse_rotated_point_jacobian(q, a) - central_differences<3, 4>(rotate_back, q_vec))
                .cwiseAbs()
                .maxCoeff(),
            1e-7);
  for (const double scale : {1.0, 1e-5, 0.0}) {
    const Eigen::Vector3d small = scale * phi;
    const auto exponential = [](const Eigen::Vector3d& v) -> Eigen::Vector4d {
      return wxyz(quaternion_exp(v));
    };
    EXPECT_LT((quaternion_exp_jacobian(small) - central_differences<4, 3>(exponential, small))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-8);
  }
  const auto normalise = [](const Eigen::Vector4d& v) -> Eigen::Vector4d { return v.normalized(); };
  const Eigen::Vector4d stretched = 1.3 * q_vec;
  EXPECT_LT((normalisation_jacobian(stretched) - central_differences<4, 4>(normalise, stretched))
                .cwiseAbs()
                .maxCoeff(),
            1e-8);
  const auto from_left = [&](const Eigen::Vector3d& d) -> Eigen::Vector4d {
    return wxyz(quaternion_exp(d) * q);
  };
  const auto from_right = [&](const Eigen::Vector3d& d) -> Eigen::Vector4d {
    return wxyz(q * quaternion_exp(d));
  };
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  EXPECT_LT(
      (left_perturbation_jacobian(q) - central_differences<4, 3>(from_left, zero)).cwiseAbs().maxCoeff(),
      1e-8);
  EXPECT_LT(
      (right_perturbation_jacobian(q) - central_differences<4, 3>(from_right, zero)).cwiseAbs().maxCoeff(),
      1e-8);
}

TEST_P(RotationSeed, ProductMatricesMultiplyQuaternions) {
  const Eigen::Quaterniond a = quaternion_exp(random_vector(rng_, 2.0));
  const Eigen::Quaterniond b = quaternion_exp(random_vector(rng_, 2.0));
  EXPECT_LT((left_product_matrix(a) * wxyz(b) - wxyz(a * b)).norm(), 1e-12);
  EXPECT_LT((right_product_matrix(b) * wxyz(a) - wxyz(a * b)).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RotationSeed, testing::Range(1U, 21U));

}  // namespace
}  // namespace cosight
