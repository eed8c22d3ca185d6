#include <gtest/gtest.h>

#include <random>

#include "robot_agent/vins/distance_factor.hpp"
#include "robot_agent/vins/imu_factor.hpp"
#include "robot_agent/vins/prior_factor.hpp"
#include "robot_agent/vins/reprojection_factor.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/numeric_jacobian.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Blocks = std::vector<std::vector<double>>;

std::vector<double> as_vector(const auto& block) {
  return {block.begin(), block.end()};
}

/// A seeded disturbance of a state, biases included.
NavState disturbed(NavState state, std::mt19937_64& random, double size) {
  std::normal_distribution<double> n(0.0, size);
  const auto draw = [&] { return Eigen::Vector3d(n(random), n(random), n(random)); };
  state.T_WB.p += draw();
  state.T_WB.q = state.T_WB.q * quaternion_exp(draw());
  state.v_W += draw();
  state.bias.accelerometer += draw();
  state.bias.gyroscope += 0.1 * draw();
  return state;
}

class FactorJacobian : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, FactorJacobian, testing::Range(0U, 10U));

TEST_P(FactorJacobian, OfTheImuMatchesCentralDifferences) {
  SyntheticDrive drive(GetParam());
  std::mt19937_64 random(GetParam());
  const double t = 0.3 * GetParam();
  const Preintegration imu(drive.imu(t, t + 0.1), {}, drive.noise);
  const NavState i = disturbed(drive.state(t), random, 0.05);
  const NavState j = disturbed(drive.state(t + 0.1), random, 0.05);
  const Blocks blocks{as_vector(pose_block(i.T_WB)), as_vector(motion_block(i)),
                      as_vector(pose_block(j.T_WB)), as_vector(motion_block(j))};
  const ImuFactor factor(imu, drive.gravity);
  for (std::size_t of = 0; of < blocks.size(); ++of) {
    EXPECT_LT(relative_difference(jacobians(factor, blocks, of)), 1e-6) << "block " << of;
  }
}

Blocks reprojection_blocks(unsigned seed, double lambda) {
  SyntheticDrive drive(seed);
  return {as_vector(pose_block(drive.state(1.0).T_WB)),
          as_vector(pose_block(drive.state(1.3).T_WB)),
          as_vector(pose_block(drive.T_BS())),
          {lambda, 0.002, -0.001},
          {0.004}};
}

TEST_P(FactorJacobian, OfASightingMatchesCentralDifferencesAlsoAtInfinity) {
  const double seed = GetParam();
  const MovingSighting first{{{0.3 - 0.05 * seed, 0.1}}, {{3.0, -1.0, 0.4}, {0.3, -0.5, 0.2}}};
  const MovingSighting now{{{0.25 - 0.05 * seed, 0.13}}, {{2.0, 0.5, -0.2}, {-0.4, 0.1, 0.8}}};
  const ReprojectionFactor factor(first, now, 300.0);
  for (const double lambda : {0.5, 0.05, 0.0}) {
    const Blocks blocks = reprojection_blocks(GetParam(), lambda);
    for (std::size_t of = 0; of < blocks.size(); ++of) {
      const JacobianPair pair = jacobians(factor, blocks, of);
      EXPECT_LT((pair.analytic - pair.numeric).cwiseAbs().maxCoeff(), 2e-4)
          << "block " << of << " at " << lambda;
    }
  }
}

TEST_P(FactorJacobian, OfAPriorMatchesCentralDifferences) {
  SyntheticDrive drive(GetParam());
  std::srand(GetParam());
  Prior prior;
  const NavState at = drive.state(1.0);
  const std::vector<double> pose = as_vector(pose_block(at.T_WB));
  const std::vector<double> motion = as_vector(motion_block(at));
  prior.blocks.push_back({{StateKind::kPose, 3}, Eigen::Map<const Eigen::VectorXd>(pose.data(), 7)});
  prior.blocks.push_back({{StateKind::kMotion, 3}, Eigen::Map<const Eigen::VectorXd>(motion.data(), 9)});
  prior.J = Eigen::MatrixXd::Random(15, 15);
  prior.residual = Eigen::VectorXd::Random(15);
  const PriorFactor factor(prior);
  EXPECT_LT((evaluate(factor, {pose, motion}) - prior.residual).norm(), 1e-12);
  EXPECT_LT(relative_difference(jacobians(factor, {pose, motion}, 0)), 1e-6);
  EXPECT_LT(relative_difference(jacobians(factor, {pose, motion}, 1)), 1e-6);
}

TEST(ReprojectionFactor, IsZeroWhereTheLandmarkReallyIs) {
  SyntheticDrive drive(5);
  const FeatureFrame before = drive.camera(1.0, 0.0);
  const FeatureFrame after = drive.camera(1.3, 0.0);
  const Pose T_WS = drive.state(1.0).T_WB * drive.T_BS();
  const Pose T_WSj = drive.state(1.3).T_WB * drive.T_BS();
  int checked = 0;
  for (const TrackedFeature& first : before.features) {
    for (const TrackedFeature& now : after.features) {
      if (first.id != now.id) continue;
      // The distance along the first ray by the law of sines.
      const Eigen::Vector3d ray_i = T_WS.q * first.sighting.bearing();
      const Eigen::Vector3d ray_j = T_WSj.q * now.sighting.bearing();
      const Eigen::Vector3d b = T_WSj.p - T_WS.p;
      const double distance = ray_j.cross(b).norm() / ray_j.cross(ray_i).norm();
      const ReprojectionFactor factor({first.sighting}, {now.sighting}, 300.0);
      Blocks blocks = reprojection_blocks(5, 1.0 / distance);
      blocks[3] = {1.0 / distance, 0.0, 0.0};
      blocks[4][0] = 0.0;
      EXPECT_LT(evaluate(factor, blocks).norm(), 1e-9);
      ++checked;
    }
  }
  EXPECT_GT(checked, 20);
}

TEST_P(FactorJacobian, OfAFirstSightingMatchesCentralDifferences) {
  const HostFactor factor(300.0);
  const Blocks blocks{{0.1, 0.002 * GetParam(), -0.001}};
  EXPECT_LT(relative_difference(jacobians(factor, blocks, 0)), 1e-9);
}

TEST_P(FactorJacobian, OfAKnownDistanceMatchesCentralDifferences) {
  const DistanceFactor factor({.lambda = 0.12, .sigma = 0.004});
  const Blocks blocks{{0.1 + 0.01 * GetParam(), 0.002, -0.001}};
  EXPECT_LT(relative_difference(jacobians(factor, blocks, 0)), 1e-9);
  EXPECT_NEAR(evaluate(factor, blocks)(0), (blocks[0][0] - 0.12) / 0.004, 1e-12);
}

TEST(HostBearing, MovesInTheTangentPlaneOfTheFirstSighting) {
  Sighting first;
  first.point = {0.3, -0.2};
  EXPECT_LT((host_bearing(first, {0.0, 0.0}) - first.bearing()).norm(), 1e-12);
  const Eigen::Vector3d moved = host_bearing(first, {0.003, 0.004});
  EXPECT_NEAR(moved.cross(first.bearing()).norm(), std::sin(std::atan(0.005)), 1e-9);
  EXPECT_LT((tangent_basis(first.bearing()) * moved - Eigen::Vector2d(0.003, 0.004)).norm(), 1e-6);
}

TEST(ReprojectionFactor, MeasuresAnglesInUnitsOfTheirDeviation) {
  const Pose origin;
  const Blocks blocks{as_vector(pose_block(origin)),
                      as_vector(pose_block(origin)),
                      as_vector(pose_block(origin)),
                      {0.1, 0.0, 0.0},
                      {0.0}};
  const double angle = 0.01;
  const ReprojectionFactor factor({{{0.0, 0.0}}}, {{{std::tan(angle), 0.0}}}, 300.0);
  EXPECT_NEAR(evaluate(factor, blocks).norm(), 300.0 * angle, 1e-3);
}

TEST(TangentBasis, IsOrthonormalEverywhere) {
  for (const Eigen::Vector3d& f :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.6, 0, 0.8)}) {
    const auto basis = tangent_basis(f);
    EXPECT_LT((basis * basis.transpose() - Eigen::Matrix2d::Identity()).norm(), 1e-12);
    EXPECT_LT((basis * f).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace cosight::vins
