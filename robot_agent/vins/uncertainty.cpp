#include "robot_agent/vins/uncertainty.hpp"

#include <Eigen/Cholesky>
#include <vector>

#include "robot_agent/vins/linearisation.hpp"

namespace cosight::vins {

namespace {

/// Covariance of some states, given everything in the window.
Eigen::MatrixXd covariance_of(const std::vector<StateKey>& states, const Window& window,
                              const GraphOptions& options) {
  FactorGraph graph(window, options, GraphScope::kWhole);
  const StateLayout layout(graph.free_states(), states);
  const NormalEquations system = linearise(graph, layout);
  const Eigen::MatrixXd chosen = Eigen::MatrixXd::Identity(layout.size(), layout.first_size());
  return system.H.ldlt().solve(chosen).topRows(layout.first_size());
}

}  // namespace

Eigen::Matrix<double, 15, 15> state_covariance(const Window& window, const GraphOptions& options,
                                               FrameId frame) {
  return covariance_of({{StateKind::kPose, frame}, {StateKind::kMotion, frame}}, window, options);
}

Eigen::Matrix<double, 6, 6> extrinsics_covariance(const Window& window, const GraphOptions& options) {
  return covariance_of({{StateKind::kExtrinsics, 0}}, window, options);
}

double time_offset_variance(const Window& window, const GraphOptions& options) {
  return covariance_of({{StateKind::kTimeOffset, 0}}, window, options)(0, 0);
}

}  // namespace cosight::vins
