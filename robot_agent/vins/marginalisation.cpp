#include "robot_agent/vins/marginalisation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>
#include <vector>

namespace cosight::vins {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Prior to_prior(const NormalEquations& system, const std::vector<StateKey>& keys, FactorGraph& graph) {
  Prior prior;
  for (const StateKey& key : keys) {
    prior.blocks.push_back({key, Eigen::Map<const VectorXd>(graph.block(key), ambient_size(key.kind))});
  }
  SquareRoot root = square_root(system);
  prior.J = std::move(root.J);
  prior.residual = std::move(root.r);
  return prior;
}

}  // namespace

NormalEquations schur_complement(const NormalEquations& system, Index count) {
  const Index rest = system.H.rows() - count;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> corner(system.H.topLeftCorner(count, count));
  const VectorXd& values = corner.eigenvalues();
  const double smallest = 1e-14 * std::max(values.maxCoeff(), 1.0);
  const VectorXd inverse = (values.array() > smallest).select(values.cwiseInverse(), 0.0);
  const MatrixXd half = inverse.cwiseSqrt().asDiagonal() * corner.eigenvectors().transpose();
  const MatrixXd coupling = half * system.H.topRightCorner(count, rest);
  NormalEquations out{system.H.bottomRightCorner(rest, rest), system.b.tail(rest)};
  out.H.noalias() -= coupling.transpose() * coupling;
  out.b.noalias() -= coupling.transpose() * (half * system.b.head(count));
  return out;
}

SquareRoot square_root(const NormalEquations& system) {
  // Units differ by many powers of ten: scaled to a unit diagonal, one threshold tells rank from rounding.
  const VectorXd scale = (system.H.diagonal().array() > 0.0)
                             .select(system.H.diagonal().cwiseSqrt(), VectorXd::Ones(system.b.size()));
  const VectorXd unscale = scale.cwiseInverse();
  const Eigen::LDLT<MatrixXd> ldlt(unscale.asDiagonal() * system.H * unscale.asDiagonal());
  constexpr double kRankThreshold = 1e-12;
  const VectorXd D = (ldlt.vectorD().array() > kRankThreshold).select(ldlt.vectorD(), 0.0);
  const VectorXd root_D = D.cwiseSqrt();
  const VectorXd inverse_root_D = (D.array() > 0.0).select(root_D.cwiseInverse(), 0.0);
  const MatrixXd L_T_P =
      ldlt.matrixU() * MatrixXd(ldlt.transpositionsP() * MatrixXd::Identity(D.size(), D.size()));
  VectorXd r = ldlt.transpositionsP() * (unscale.asDiagonal() * system.b);
  ldlt.matrixL().solveInPlace(r);
  return {root_D.asDiagonal() * L_T_P * scale.asDiagonal(), inverse_root_D.asDiagonal() * r};
}

Prior marginalise_oldest(const Window& window, const GraphOptions& options) {
  FactorGraph graph(window, options, GraphScope::kOldestFrame);
  const FrameId oldest = window.frames.front().id;
  const StateLayout layout(graph.free_states(), {{StateKind::kPose, oldest}, {StateKind::kMotion, oldest}});
  const NormalEquations system = schur_complement(linearise(graph, layout), layout.first_size());
  return to_prior(system, layout.rest(), graph);
}

Prior marginalise_frame(const Window& window, const GraphOptions& options, FrameId frame) {
  FactorGraph graph(window, options, GraphScope::kPrior);
  const StateLayout layout(graph.prior_keys(), {{StateKind::kPose, frame}, {StateKind::kMotion, frame}});
  if (layout.first_size() == 0) return window.prior;
  return to_prior(schur_complement(linearise(graph, layout), layout.first_size()), layout.rest(), graph);
}

}  // namespace cosight::vins
