#pragma once

#include <ceres/cost_function.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "robot_agent/vins/parameter_blocks.hpp"

namespace cosight::vins {

/// The Jacobian of a factor with respect to the tangent of one block, once as the factor says and once by
/// central differences.
struct JacobianPair {
  Eigen::MatrixXd analytic;
  Eigen::MatrixXd numeric;
};

inline std::vector<double> stepped(const std::vector<double>& block, Eigen::Index axis, double step) {
  std::vector<double> out = block;
  if (block.size() != 7) {
    out[static_cast<std::size_t>(axis)] += step;
    return out;
  }
  Eigen::Matrix<double, 6, 1> delta = Eigen::Matrix<double, 6, 1>::Zero();
  delta(axis) = step;
  PoseManifold().Plus(block.data(), delta.data(), out.data());
  return out;
}

inline Eigen::VectorXd evaluate(const ceres::CostFunction& factor,
                                const std::vector<std::vector<double>>& blocks,
                                double** jacobians = nullptr) {
  std::vector<const double*> parameters;
  for (const auto& block : blocks)
    parameters.push_back(block.data());
  Eigen::VectorXd r(factor.num_residuals());
  factor.Evaluate(parameters.data(), r.data(), jacobians);
  return r;
}

inline JacobianPair jacobians(const ceres::CostFunction& factor, std::vector<std::vector<double>> blocks,
                              std::size_t of, double step = 1e-6) {
  const auto rows = static_cast<Eigen::Index>(factor.num_residuals());
  const Eigen::Index size = blocks[of].size() == 7 ? 6 : static_cast<Eigen::Index>(blocks[of].size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> ambient(
      rows, static_cast<Eigen::Index>(blocks[of].size()));
  std::vector<double*> pointers(blocks.size(), nullptr);
  pointers[of] = ambient.data();
  evaluate(factor, blocks, pointers.data());
  JacobianPair pair{ambient.leftCols(size), Eigen::MatrixXd(rows, size)};
  const std::vector<double> at = blocks[of];
  for (Eigen::Index axis = 0; axis < size; ++axis) {
    blocks[of] = stepped(at, axis, step);
    const Eigen::VectorXd plus = evaluate(factor, blocks);
    blocks[of] = stepped(at, axis, -step);
    pair.numeric.col(axis) = (plus - evaluate(factor, blocks)) / (2.0 * step);
  }
  return pair;
}

/// Largest entry of the difference, in parts of the largest entry.
inline double relative_difference(const JacobianPair& pair) {
  const double largest = pair.numeric.cwiseAbs().maxCoeff();
  return (pair.analytic - pair.numeric).cwiseAbs().maxCoeff() / std::max(largest, 1e-12);
}

}  // namespace cosight::vins
