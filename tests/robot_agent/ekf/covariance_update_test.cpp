// The kernels of every instruction set that this machine has: right, and the same to the last bit.
#include "robot_agent/ekf/covariance_update.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "robot_agent/ekf/downdate_dispatch.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

class CovarianceUpdateKernels : public testing::TestWithParam<int> {
 protected:
  CovarianceUpdateKernels() {  // a state of GetParam() landmarks, half of them measured
    state.append(VectorXd::Zero(13), {}, scene.covariance(13, 1.0));
    for (int i = 0; i < GetParam(); ++i) {
      LinearisedMeasurement m;
      GaussianState::Dependence on_camera{0, MatrixXd::Random(6, 7)};
      m.offset = state.append(scene.normals(6), {&on_camera, 1}, scene.covariance(6, 0.5));
      m.rows = i % 3 == 0 ? 3 : 2;
      for (Eigen::Index k = 0; k < m.H_camera.size(); ++k)
        m.H_camera.data()[k] = scene.normal();
      for (Eigen::Index k = 0; k < m.H_landmark.size(); ++k)
        m.H_landmark.data()[k] = scene.normal();
      m.innovation = scene.normals(3);
      m.R = scene.covariance(3, 1.0);
      if (i % 2 == 0) innovation.push_back(m);
    }
    innovation.compute(state, false);
  }
  static MatrixXd whole(const GaussianState& s) { return s.P_lower().selfadjointView<Eigen::Lower>(); }

  RandomScene scene{7};
  GaussianState state{13 + 6 * GetParam()};
  JointInnovation innovation{13 + 6 * GetParam(), 3 * GetParam()};
};

TEST_P(CovarianceUpdateKernels, AgreeWithTheTextbook) {
  const MatrixXd S = MatrixXd(innovation.S_lower()).selfadjointView<Eigen::Lower>();
  const MatrixXd K = MatrixXd(innovation.P_Ht()) * S.inverse();
  const MatrixXd expected = whole(state) - K * S * K.transpose();
  const VectorXd correction = K * innovation.g();
  for (const kernel::KernelSet& kernels : kernel::available_kernels()) {
    SCOPED_TRACE(kernels.name);
    GaussianState updated = state;
    CovarianceUpdate update(state.capacity(), 3 * GetParam(), kernels);
    ASSERT_TRUE(update.factorise(innovation));
    update.downdate(updated);
    EXPECT_LT((whole(updated) - expected).norm(), 1e-9 * expected.norm());
    EXPECT_LT((update.correction() - correction).norm(), 1e-9 * correction.norm());
    EXPECT_NEAR(update.nis(), innovation.g().dot(S.inverse() * innovation.g()), 1e-9 * update.nis());
  }
}

TEST_P(CovarianceUpdateKernels, GiveTheSameBytes) {
  const auto kernels = kernel::available_kernels();
  std::vector<MatrixXd> results;
  std::vector<VectorXd> corrections;
  for (const kernel::KernelSet& set : kernels) {
    GaussianState updated = state;
    CovarianceUpdate update(state.capacity(), 3 * GetParam(), set);
    ASSERT_TRUE(update.factorise(innovation));
    update.downdate(updated);
    results.push_back(whole(updated));
    corrections.emplace_back(update.correction());
  }
  for (std::size_t i = 1; i < kernels.size(); ++i) {
    SCOPED_TRACE(kernels[i].name);
    EXPECT_EQ(results[i], results[0]);
    EXPECT_EQ(corrections[i], corrections[0]);
  }
}

TEST_P(CovarianceUpdateKernels, LeaveTheUpperTriangleAlone) {
  for (const kernel::KernelSet& kernels : kernel::available_kernels()) {
    GaussianState updated = state;
    CovarianceUpdate update(state.capacity(), 3 * GetParam(), kernels);
    ASSERT_TRUE(update.factorise(innovation));
    update.downdate(updated);
    const MatrixXd before = MatrixXd(state.P_lower()).triangularView<Eigen::StrictlyUpper>();
    const MatrixXd after = MatrixXd(updated.P_lower()).triangularView<Eigen::StrictlyUpper>();
    EXPECT_EQ(after, before) << kernels.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Landmarks, CovarianceUpdateKernels, testing::Values(1, 2, 3, 8, 17, 40));

}  // namespace
}  // namespace cosight::ekf
