#include "tests/robot_agent/slam/world_runs.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace cosight::slam {

const TwoCameraWorld& world() {
  return TwoCameraWorld::instance();
}

std::vector<FrameEstimate> run(CollaborativeSlam& slam, int first, int last) {
  std::vector<FrameEstimate> estimates;
  for (int frame = first; frame < last; ++frame)
    estimates.push_back(slam.process(world().bundle(frame)));
  return estimates;
}

std::vector<FrameEstimate> run_without_wearer(CollaborativeSlam& slam, int first, int last) {
  std::vector<FrameEstimate> estimates;
  for (int frame = first; frame < last; ++frame)
    estimates.push_back(slam.process(world().without_wearer(frame)));
  return estimates;
}

CollaborativeSlam collaborative() {
  return CollaborativeSlam(world().camera(), world().options());
}

double position_error(const FrameEstimate& estimate, int frame) {
  return (estimate.T_WS.T.p - world().T_WS(frame).p).norm();
}

double position_std(const FrameEstimate& estimate) {
  return std::sqrt(estimate.T_WS.covariance.topLeftCorner<3, 3>().trace());
}

int points_fused(const std::vector<FrameEstimate>& estimates) {
  int fused = 0;
  for (const FrameEstimate& estimate : estimates)
    fused += estimate.pseudo_stereo.fused;
  return fused;
}

void expect_sound(const FrameEstimate& estimate) {
  ASSERT_TRUE(estimate.T_WS.T.p.allFinite() && estimate.T_WS.T.q.coeffs().allFinite());
  ASSERT_TRUE(estimate.v_W.allFinite() && estimate.omega_S.allFinite());
  EXPECT_NEAR(estimate.T_WS.T.q.norm(), 1.0, 1e-9);
  ASSERT_TRUE(estimate.T_WS.covariance.allFinite() && estimate.twist_covariance.allFinite());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(estimate.T_WS.covariance);
  EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
}

}  // namespace cosight::slam
