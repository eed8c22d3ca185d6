#include "robot_agent/vins/marginalisation.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

namespace cosight::vins {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

NormalEquations random_system(unsigned seed, Eigen::Index rows, Eigen::Index size) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> n;
  const MatrixXd J = MatrixXd::NullaryExpr(rows, size, [&] { return n(random); });
  const VectorXd r = VectorXd::NullaryExpr(rows, [&] { return n(random); });
  return {J.transpose() * J, J.transpose() * r};
}

TEST(SchurComplement, LeavesTheSolutionAndCovarianceOfTheRest) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const NormalEquations whole = random_system(seed, 40, 12);
    const NormalEquations rest = schur_complement(whole, 5);
    const VectorXd all = -whole.H.ldlt().solve(whole.b);
    EXPECT_LT((all.tail(7) + rest.H.ldlt().solve(rest.b)).norm(), 1e-9);
    EXPECT_LT((whole.H.inverse().bottomRightCorner(7, 7) - rest.H.inverse()).norm(), 1e-9);
  }
}

TEST(SchurComplement, IgnoresDirectionsThatNothingWasKnownOf) {
  NormalEquations whole = random_system(1, 40, 12);
  whole.H.row(2).setZero();
  whole.H.col(2).setZero();
  whole.b(2) = 0.0;
  EXPECT_TRUE(schur_complement(whole, 5).H.allFinite());
}

TEST(SquareRoot, GivesTheSystemBack) {
  for (const Eigen::Index rows : {40, 6}) {  // of full rank, and not
    NormalEquations system = random_system(3, rows, 10);
    const VectorXd units =
        VectorXd::LinSpaced(10, -4.0, 4.0).unaryExpr([](double e) { return std::pow(10.0, e); });
    system.H = (units.asDiagonal() * system.H * units.asDiagonal()).eval();
    system.b = (units.asDiagonal() * system.b).eval();
    const SquareRoot root = square_root(system);
    const MatrixXd unscale = units.cwiseInverse().asDiagonal();
    EXPECT_LT((unscale * (root.J.transpose() * root.J - system.H) * unscale).norm(), 1e-8);
    EXPECT_LT((unscale * (root.J.transpose() * root.r - system.b)).norm(), 1e-8);
  }
}

}  // namespace
}  // namespace cosight::vins
