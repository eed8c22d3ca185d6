// HOHCT against brute force: every subset tried with a fresh factorisation.
#include "robot_agent/ekf/joint_compatibility.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <bit>

#include "robot_agent/ekf/filter.hpp"
#include "tests/robot_agent/ekf/random_scene.hpp"

namespace cosight::ekf {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Pairings of two or three rows with a given g and S, by way of a state in which each has its own landmark.
struct Pairings {
  Pairings(RandomScene& scene, const std::vector<int>& rows, double correlation) : rows_of(rows) {
    int total = 0;
    for (const int r : rows)
      total += r;
    const MatrixXd common = scene.covariance(CameraState::kPoseDim, correlation);
    GaussianState state(CameraState::kDim + 6 * static_cast<int>(rows.size()));
    MatrixXd P_camera = 0.01 * MatrixXd::Identity(13, 13);
    P_camera.topLeftCorner<7, 7>() += common;
    state.append(VectorXd::Zero(13), {}, P_camera);
    innovation.clear();
    MatrixXd H = MatrixXd::Zero(total, 13 + 6 * static_cast<Index>(rows.size()));
    MatrixXd R = MatrixXd::Zero(total, total);
    int row = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      LinearisedMeasurement m;
      m.measurement = static_cast<int>(i);
      m.rows = rows[i];
      m.offset = state.append(VectorXd::Zero(6), {}, scene.covariance(6, 0.5));
      for (Index k = 0; k < m.H_camera.size(); ++k)
        m.H_camera.data()[k] = scene.normal();
      for (Index k = 0; k < m.H_landmark.size(); ++k)
        m.H_landmark.data()[k] = scene.normal();
      m.R = scene.covariance(3, 0.7);
      linearised.push_back(m);
      H.block(row, 0, m.rows, 7) = m.H_camera.topRows(m.rows);
      H.block(row, m.offset, m.rows, 6) = m.H_landmark.topRows(m.rows);
      R.block(row, row, m.rows, m.rows) = m.R.topLeftCorner(m.rows, m.rows);
      row += m.rows;
    }
    const MatrixXd P = state.P_lower().selfadjointView<Eigen::Lower>();
    S = H * P * H.transpose() + R;
    g = S.llt().matrixL() * scene.normals(total);
    kept_state = state;
  }

  void spoil(int pairing, double sigmas) {
    int row = 0;
    for (int i = 0; i < pairing; ++i)
      row += rows_of[static_cast<std::size_t>(i)];
    g(row) += sigmas * std::sqrt(S(row, row));
    g(row + 1) -= sigmas * std::sqrt(S(row + 1, row + 1));
  }

  const JointInnovation& compute() {
    innovation.clear();
    int row = 0;
    for (LinearisedMeasurement& m : linearised) {
      m.innovation.head(m.rows) = g.segment(row, m.rows);
      row += m.rows;
      innovation.push_back(m);
    }
    innovation.compute(kept_state, false);
    return innovation;
  }

  double distance(unsigned off) const {
    std::vector<Index> kept;
    Index row = 0;
    for (std::size_t i = 0; i < rows_of.size(); ++i) {
      for (int k = 0; k < rows_of[i]; ++k, ++row) {
        if ((off >> i & 1U) == 0) kept.push_back(row);
      }
    }
    return kept.empty() ? 0.0 : VectorXd(g(kept)).dot(MatrixXd(S(kept, kept)).llt().solve(VectorXd(g(kept))));
  }
  int rows(unsigned off) const {
    int sum = 0;
    for (std::size_t i = 0; i < rows_of.size(); ++i)
      sum += (off >> i & 1U) == 0 ? rows_of[i] : 0;
    return sum;
  }

  std::vector<int> rows_of;
  MatrixXd S;
  VectorXd g;
  std::vector<LinearisedMeasurement> linearised;
  JointInnovation innovation{200, 8};
  GaussianState kept_state{13};
};

/// The hypothesis HOHCT defines, by trying all of them; up to three removals.
unsigned brute_force(const Pairings& pairings, double probability) {
  const auto count = static_cast<unsigned>(pairings.rows_of.size());
  for (int removals = 0; removals <= 3; ++removals) {
    unsigned best = 0;
    double best_ratio = 1.0;
    bool found = false;
    for (unsigned off = 0; off < 1U << count; ++off) {
      if (std::popcount(off) != removals) continue;
      const double ratio = pairings.distance(off) / chi_squared_quantile(probability, pairings.rows(off));
      if (ratio > best_ratio) continue;
      best_ratio = ratio;
      best = off;
      found = true;
    }
    if (found) return best;
  }
  return ~0U;
}

unsigned off_bits(const Hypothesis& hypothesis) {
  unsigned bits = 0;
  for (std::size_t i = 0; i < hypothesis.keep.size(); ++i)
    bits |= hypothesis.keep[i] == 0 ? 1U << i : 0U;
  return bits;
}

/// Each kept pairing against all others with a fresh inverse, from the definition of a conditional Gaussian:
/// the innovation g_k - S_kr S_rr^-1 g_r and its covariance S_kk - S_kr S_rr^-1 S_rk. Worst first.
unsigned without_improbable(const Pairings& pairings, unsigned off, double probability) {
  for (;;) {
    int worst = -1;
    double worst_ratio = 1.0;
    for (int k = 0; k < static_cast<int>(pairings.rows_of.size()); ++k) {
      if ((off >> k & 1U) != 0) continue;
      std::vector<Index> own;
      std::vector<Index> rest;
      Index row = 0;
      for (int i = 0; i < static_cast<int>(pairings.rows_of.size()); ++i) {
        for (int n = 0; n < pairings.rows_of[static_cast<std::size_t>(i)]; ++n, ++row) {
          if ((off >> i & 1U) == 0) (i == k ? own : rest).push_back(row);
        }
      }
      const MatrixXd gain =
          MatrixXd(pairings.S(rest, rest)).llt().solve(MatrixXd(pairings.S(rest, own))).transpose();
      const VectorXd innovation = pairings.g(own) - gain * pairings.g(rest);
      const MatrixXd covariance = pairings.S(own, own) - gain * pairings.S(rest, own);
      const double ratio = innovation.dot(covariance.llt().solve(innovation)) /
                           chi_squared_quantile(probability, static_cast<int>(own.size()));
      if (ratio <= worst_ratio) continue;
      worst_ratio = ratio;
      worst = k;
    }
    if (worst < 0) return off;
    off |= 1U << worst;
  }
}

constexpr JointCompatibilityOptions kTogetherOnly{.each_probability = 1.0};

class JointCompatibilityTest : public testing::TestWithParam<unsigned> {};

TEST_P(JointCompatibilityTest, FindsWhatBruteForceFinds) {
  RandomScene scene(GetParam());
  std::vector<int> rows(9, 2);
  if (GetParam() % 2 == 0) rows = {2, 3, 2, 3, 3, 2, 2, 3, 2};  // pixels and points
  Pairings pairings(scene, rows, 1.0);
  const unsigned spoiled = GetParam() % 4;
  for (unsigned i = 0; i < spoiled; ++i)
    pairings.spoil(static_cast<int>(3 * i + GetParam() % 3), 6.0);
  JointCompatibility test(kTogetherOnly);
  const Hypothesis& hypothesis = test.test(pairings.compute());
  const unsigned expected = brute_force(pairings, 0.95);
  ASSERT_NE(expected, ~0U);
  EXPECT_EQ(off_bits(hypothesis), expected);
  EXPECT_TRUE(hypothesis.exact);
  EXPECT_EQ(hypothesis.rows, pairings.rows(expected));
  EXPECT_NEAR(hypothesis.distance, pairings.distance(expected), 1e-8 * (1.0 + hypothesis.distance));
  EXPECT_NEAR(hypothesis.limit, chi_squared_quantile(0.95, hypothesis.rows), 1e-12);
}

TEST_P(JointCompatibilityTest, TakesOffManyWrongPairingsAndSaysThatItWasGreedy) {
  RandomScene scene(GetParam());
  Pairings pairings(scene, std::vector<int>(24, 2), 0.3);
  unsigned wrong = 0;
  for (int i = 0; i < 7; ++i) {
    pairings.spoil(3 * i, 30.0);
    wrong |= 1U << (3 * i);
  }
  JointCompatibility test(kTogetherOnly);
  const Hypothesis& hypothesis = test.test(pairings.compute());
  EXPECT_FALSE(hypothesis.exact);
  EXPECT_EQ(off_bits(hypothesis) & wrong, wrong);
  EXPECT_LE(hypothesis.removed, 8);
  EXPECT_LE(hypothesis.distance, hypothesis.limit);
  EXPECT_NEAR(hypothesis.distance, pairings.distance(off_bits(hypothesis)), 1e-7);
}

/// Half of the seeds leave the joint test nothing to do; spoiled by 2.5 sigmas only, a pairing hides in the
/// joint distance of the others.
TEST_P(JointCompatibilityTest, DropsWhatIsImprobableGivenAllOthers) {
  RandomScene scene(GetParam());
  std::vector<int> rows(12, 2);
  if (GetParam() % 2 == 0) rows = {2, 3, 2, 3, 3, 2, 2, 3, 2, 2};
  Pairings pairings(scene, rows, 1.0);
  pairings.spoil(1, 2.5);
  if (GetParam() % 4 < 2) pairings.spoil(4, 8.0);
  constexpr double kEach = 0.9;
  JointCompatibility test({.each_probability = kEach});
  const Hypothesis& hypothesis = test.test(pairings.compute());
  const unsigned together = brute_force(pairings, 0.95);
  const unsigned expected = without_improbable(pairings, together, kEach);
  EXPECT_EQ(off_bits(hypothesis), expected);
  EXPECT_EQ(hypothesis.removed, std::popcount(expected));
  EXPECT_EQ(hypothesis.improbable, std::popcount(expected) - std::popcount(together));
  EXPECT_EQ(hypothesis.rows, pairings.rows(expected));
  EXPECT_NEAR(hypothesis.distance, pairings.distance(expected), 1e-8 * (1.0 + hypothesis.distance));
}

INSTANTIATE_TEST_SUITE_P(Seeds, JointCompatibilityTest, testing::Range(1U, 25U));

TEST(JointCompatibility, KeepsNothingWhenNothingIsCompatible) {
  RandomScene scene(1);
  Pairings pairings(scene, {2, 2, 3}, 0.01);
  for (int i = 0; i < 3; ++i)
    pairings.spoil(i, 1e3);
  JointCompatibility test;
  const Hypothesis& hypothesis = test.test(pairings.compute());
  EXPECT_EQ(hypothesis.removed, 3);
  EXPECT_EQ(hypothesis.rows, 0);
}

TEST(JointCompatibility, OfNothingIsEmpty) {
  JointCompatibility test;
  const JointInnovation nothing(13, 4);
  EXPECT_TRUE(test.test(nothing).keep.empty());
}

TEST(ChiSquared, QuantilesMatchTables) {
  EXPECT_NEAR(chi_squared_quantile(0.95, 1), 3.841459, 1e-6);
  EXPECT_NEAR(chi_squared_quantile(0.95, 2), 5.991465, 1e-6);
  EXPECT_NEAR(chi_squared_quantile(0.99, 6), 16.811894, 1e-6);
  EXPECT_NEAR(chi_squared_quantile(0.025, 300), 253.9123, 1e-4);
  EXPECT_NEAR(chi_squared_quantile(0.999, 80), 124.8392, 1e-4);
  EXPECT_EQ(chi_squared_quantile(0.5, 0), 0.0);
  EXPECT_TRUE(std::isinf(chi_squared_quantile(1.0, 2)));
  const ChiSquaredLimits limits(0.95, 3);
  EXPECT_NEAR(limits(3), 7.814728, 1e-6);
  EXPECT_NEAR(limits(4), 9.487729, 1e-6);  // beyond its table
}

TEST(JointInnovation, KeepOnlyLeavesThePartsOfTheWhole) {
  RandomScene scene(5);
  Pairings pairings(scene, {2, 3, 2, 3, 2, 3}, 1.0);
  JointInnovation all = pairings.compute();
  const VectorXd g = all.g();
  const MatrixXd S = all.S_lower();
  const MatrixXd P_Ht = all.P_Ht();
  const std::vector<char> keep{0, 1, 0, 1, 1, 0};
  all.keep_only(keep);
  const std::vector<Index> rows{2, 3, 4, 7, 8, 9, 10, 11};
  ASSERT_EQ(all.rows(), 8);
  EXPECT_EQ(VectorXd(all.g()), VectorXd(g(rows)));
  EXPECT_EQ(MatrixXd(all.P_Ht()), MatrixXd(P_Ht(Eigen::all, rows)));
  const MatrixXd kept = S(rows, rows);
  EXPECT_EQ(MatrixXd(MatrixXd(all.S_lower()).triangularView<Eigen::Lower>()),
            MatrixXd(kept.triangularView<Eigen::Lower>()));
  EXPECT_EQ(all.measurements()[2].measurement, 4);
  EXPECT_EQ(all.measurements()[2].row, 6);
}

}  // namespace
}  // namespace cosight::ekf
