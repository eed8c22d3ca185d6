#include "robot_agent/vins/prior_factor.hpp"

#include "robot_agent/vins/parameter_blocks.hpp"

namespace cosight::vins {
namespace {

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

PriorFactor::PriorFactor(const Prior& prior) : prior_(prior) {
  set_num_residuals(static_cast<int>(prior.residual.size()));
  for (const Prior::Block& block : prior.blocks) {
    mutable_parameter_block_sizes()->push_back(ambient_size(block.key.kind));
  }
}

bool PriorFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  Eigen::VectorXd dx(prior_.J.cols());
  Eigen::Index column = 0;
  for (std::size_t i = 0; i < prior_.blocks.size(); ++i) {
    const Prior::Block& block = prior_.blocks[i];
    const int size = tangent_size(block.key.kind);
    if (ambient_size(block.key.kind) == 7) {
      dx.segment<6>(column) = difference(to_pose(parameters[i]), to_pose(block.value.data()));
    } else {
      dx.segment(column, size) = Eigen::Map<const Eigen::VectorXd>(parameters[i], size) - block.value;
    }
    if (jacobians != nullptr && jacobians[i] != nullptr) {
      Eigen::Map<RowMajorMatrix> J(jacobians[i], num_residuals(), ambient_size(block.key.kind));
      J.setZero();
      J.leftCols(size) = prior_.J.middleCols(column, size);
    }
    column += size;
  }
  Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = prior_.residual + prior_.J * dx;
  return true;
}

}  // namespace cosight::vins
