#include "robot_agent/vins/uncertainty.hpp"

#include <Eigen/Cholesky>

#include "robot_agent/vins/linearisation.hpp"

namespace cosight::vins {

Eigen::Matrix<double, 15, 15> state_covariance(const Window& window, const GraphOptions& options,
                                               FrameId frame) {
  FactorGraph graph(window, options, GraphScope::kWhole);
  const StateLayout layout(graph.free_states(), {{StateKind::kPose, frame}, {StateKind::kMotion, frame}});
  const NormalEquations system = linearise(graph, layout);
  const Eigen::MatrixXd chosen = Eigen::MatrixXd::Identity(layout.size(), 15);
  return system.H.ldlt().solve(chosen).topRows<15>();
}

}  // namespace cosight::vins
