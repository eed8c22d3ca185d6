#include "robot_agent/vins/calibration_prior.hpp"

#include <utility>

#include "robot_agent/vins/parameter_blocks.hpp"

namespace cosight::vins {
namespace {

/// A further block that is as good as `deviations` say.
void add_block(Prior& prior, StateKind kind, Eigen::VectorXd value, const Eigen::VectorXd& deviations) {
  const Eigen::Index old = prior.J.rows();
  const Eigen::Index size = old + deviations.size();
  prior.blocks.push_back({{kind, 0}, std::move(value)});
  prior.J.conservativeResizeLike(Eigen::MatrixXd::Zero(size, size));
  prior.J.diagonal().tail(deviations.size()) = deviations.cwiseInverse();
  prior.residual.conservativeResizeLike(Eigen::VectorXd::Zero(size));
}

}  // namespace

void add_calibration_prior(Prior& prior, const Window& window, const GraphOptions& options,
                           const CalibrationUncertainty& uncertainty) {
  if (options.estimate_extrinsics) {
    const PoseBlock T_BS = pose_block(window.T_BS);
    Eigen::VectorXd deviations(kPoseDim);
    deviations.head<3>().setConstant(uncertainty.position);
    deviations.tail<3>().setConstant(uncertainty.rotation);
    add_block(prior, StateKind::kExtrinsics, Eigen::Map<const Eigen::VectorXd>(T_BS.data(), 7), deviations);
  }
  if (options.estimate_time_offset) {
    add_block(prior, StateKind::kTimeOffset, Eigen::VectorXd::Constant(1, window.time_offset),
              Eigen::VectorXd::Constant(1, uncertainty.time_offset));
  }
}

}  // namespace cosight::vins
