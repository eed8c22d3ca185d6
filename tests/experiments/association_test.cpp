#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <bit>

#include "experiments/consistency/association.hpp"
#include "experiments/consistency/monte_carlo.hpp"

namespace cosight::experiments {
namespace {

/// An innovation of `pairings` pixels of known points in a filter, some of them far off.
class Pairings : public testing::TestWithParam<unsigned> {
 protected:
  const ekf::JointInnovation& innovation_of(int pairings, int wrong) {
    std::mt19937 rng(GetParam());
    std::normal_distribution<double> normal;
    UncertainPose T_WS;
    T_WS.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    filter_.reset(T_WS, 0.1, 0.1);
    std::vector<ekf::Measurement> measurements;
    for (int i = 0; i < pairings; ++i) {
      const Eigen::Vector3d p(normal(rng), normal(rng), 5.0 + normal(rng));
      const auto id = filter_.add_known_point(p, 1e-4 * Eigen::Matrix3d::Identity());
      Eigen::Vector2d pixel = filter_.predict_pixel(*id)->pixel + Eigen::Vector2d(normal(rng), normal(rng));
      if (i < wrong) pixel += Eigen::Vector2d(12.0 * normal(rng), 12.0);
      measurements.push_back(ekf::Measurement::pixel(*id, pixel, 1.0));
    }
    return filter_.innovation(measurements);
  }

  ekf::Filter filter_{CameraModel{}, {}};
};

double joint_distance(const ekf::JointInnovation& innovation, unsigned subset) {
  std::vector<int> rows;
  for (const auto& m : innovation.measurements()) {
    if ((subset >> static_cast<unsigned>(m.measurement) & 1U) == 0) continue;
    rows.push_back(m.row);
    rows.push_back(m.row + 1);
  }
  const Eigen::MatrixXd S = Eigen::MatrixXd(innovation.S_lower()).selfadjointView<Eigen::Lower>();
  const Eigen::VectorXd g = Eigen::VectorXd(innovation.g())(rows);
  return rows.empty() ? 0.0 : g.dot(Eigen::MatrixXd(S(rows, rows)).llt().solve(g));
}

TEST_P(Pairings, BranchAndBoundFindsTheLargestCompatibleSet) {
  constexpr int kPairings = 8;
  const ekf::JointInnovation& innovation = innovation_of(kPairings, 3);
  int largest = 0;
  for (unsigned subset = 0; subset < 1U << kPairings; ++subset) {
    const int size = std::popcount(subset);
    if (size > largest && joint_distance(innovation, subset) <= ekf::chi_squared_quantile(0.95, 2 * size))
      largest = size;
  }
  BranchAndBound test;
  const std::vector<char> keep = test.test(innovation);
  EXPECT_FALSE(test.was_cut());
  EXPECT_EQ(std::count(keep.begin(), keep.end(), 1), largest);
}

TEST_P(Pairings, OnePointRansacKeepsTheRightAndDropsTheFarOnes) {
  constexpr int kPairings = 16;
  constexpr int kWrong = 4;
  const std::vector<char> keep = one_point_ransac(innovation_of(kPairings, kWrong));
  EXPECT_GE(std::count(keep.begin() + kWrong, keep.end(), 1), kPairings - kWrong - 2);
  EXPECT_LE(std::count(keep.begin(), keep.begin() + kWrong, 1), 1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Pairings, testing::Range(1U, 7U));

TEST(Association, ThirtyPercentWrongMatchesHardlyGetThrough) {
  constexpr int kRuns = 10;
  RunOptions options;
  options.validation = Validation::kHohctThenEach;
  const double clean = mean_final_error(monte_carlo(options, kRuns));
  options.wrong.share = 0.3;
  for (const bool repeated : {false, true}) {
    options.wrong.repeated = repeated;
    const ConsistencyCourse course = monte_carlo(options, kRuns);
    EXPECT_GT(course.matches.wrong, 1'000);
    EXPECT_LE(course.matches.wrong_fused, course.matches.wrong / 100);
    EXPECT_LE(mean_final_error(course), 1.5 * clean);
  }
}

}  // namespace
}  // namespace cosight::experiments
