#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>
#include <vector>

namespace cosight::vins {

/// Counts the frames that ever entered a window; never used twice.
using FrameId = std::uint64_t;

enum class StateKind {
  kPose,        ///< T_WB of a frame: 7 numbers, 6 degrees of freedom
  kMotion,      ///< velocity and biases of a frame: 9
  kExtrinsics,  ///< T_BS: 7 numbers, 6 degrees of freedom
  kTimeOffset,  ///< between camera and IMU: 1
};

int ambient_size(StateKind kind);
int tangent_size(StateKind kind);

/// One block of states of the window; `frame` is zero for those that belong to no frame.
struct StateKey {
  StateKind kind = StateKind::kPose;
  FrameId frame = 0;

  auto operator<=>(const StateKey&) const = default;
};

/// What is known of the states from all that has left the window: |residual + J (x - x_0)|^2, where x - x_0
/// is the tangent of each block, one after another.
struct Prior {
  struct Block {
    StateKey key;
    Eigen::VectorXd value;  ///< x_0, as in parameter_blocks.hpp
  };

  std::vector<Block> blocks;
  Eigen::MatrixXd J;
  Eigen::VectorXd residual;

  bool empty() const { return blocks.empty(); }
  bool holds(StateKey key) const;
};

}  // namespace cosight::vins
