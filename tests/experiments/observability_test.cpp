#include <gtest/gtest.h>

#include <cmath>

#include "experiments/observability/planar_system.hpp"
#include "experiments/observability/rank.hpp"

namespace cosight::experiments {
namespace {

TEST(PrimeField, DividesExactly) {
  const PrimeField a{123'456'789'012'345'678U};
  const PrimeField b{987'654'321U};
  EXPECT_EQ((a / b * b).value(), a.value());
  EXPECT_TRUE((a - a).is_zero());
  EXPECT_EQ((PrimeField{0} - PrimeField{1} + PrimeField{2}).value(), 1U);
}

TEST(Observability, RanksArePapers) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    EXPECT_EQ(symbolic_rank({.pseudo_stereo = 0}, seed), 8);
    EXPECT_EQ(symbolic_rank({.pseudo_stereo = 1}, seed), 9);
    EXPECT_EQ(symbolic_rank({.pseudo_stereo = 2}, seed), 10);
  }
}

TEST(Observability, SingularValuesAgreeWithTheSymbolicRank) {
  for (std::size_t depths = 0; depths <= 4; ++depths) {
    const ObservabilityCase setup{.pseudo_stereo = depths};
    EXPECT_EQ(numeric_rank(singular_values(setup, 5)), symbolic_rank(setup, 5));
  }
}

TEST(Observability, ScaleIsLostOnlyWithoutDepthAndWithoutABaselineOfAnchors) {
  EXPECT_TRUE(scale_is_unobservable({.order = 3, .common_anchor = true}, 1));
  EXPECT_FALSE(scale_is_unobservable({.pseudo_stereo = 1, .order = 3, .common_anchor = true}, 1));
  EXPECT_FALSE(scale_is_unobservable({.order = 3}, 1));
}

/// The bearing's rate along f, from the arctangent itself.
double bearing(const StateVector<double>& x, const Anchor<double>& a, double t) {
  using S = PlanarSystem;
  const double rho = x[S::kRho];
  return std::atan2(x[S::kZ] + t * x[S::kVz] - a.sin_theta / rho - a.z0,
                    x[S::kX] + t * x[S::kVx] - a.cos_theta / rho - a.x0) -
         x[S::kTheta] - t * x[S::kOmega];
}

TEST(Observability, RowsAreGradientsOfTheLieDerivatives) {
  const StateVector<double> x{0.4, -0.3, 0.2, 0.6, 0.2, 0.1, 0.25, 0.2, 0.3, 0.35};
  const Anchor<double> anchor{-0.5, 0.1, std::cos(1.3), std::sin(1.3)};
  ObservabilityMatrix<double> rows;
  append_bearing_rows(x, anchor, 0, 2, rows);
  constexpr double kStep = 1e-4;
  const auto lie = [&anchor](const StateVector<double>& at, int order) {
    const double before = bearing(at, anchor, -kStep);
    const double now = bearing(at, anchor, 0.0);
    const double after = bearing(at, anchor, kStep);
    if (order == 0) return now;
    return order == 1 ? (after - before) / (2.0 * kStep) : (after - 2.0 * now + before) / (kStep * kStep);
  };
  for (int order = 0; order <= 2; ++order) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      constexpr double kChange = 1e-3;
      StateVector<double> more = x;
      StateVector<double> less = x;
      more[i] += kChange;
      less[i] -= kChange;
      const double expected = (lie(more, order) - lie(less, order)) / (2.0 * kChange);
      EXPECT_NEAR(rows[static_cast<std::size_t>(order)][i], expected, 2e-5) << order << ' ' << i;
    }
  }
}

}  // namespace
}  // namespace cosight::experiments
