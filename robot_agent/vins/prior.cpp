#include "robot_agent/vins/prior.hpp"

#include <algorithm>

namespace cosight::vins {

int ambient_size(StateKind kind) {
  switch (kind) {
    case StateKind::kPose:
    case StateKind::kExtrinsics:
      return 7;
    case StateKind::kMotion:
      return 9;
    case StateKind::kTimeOffset:
      break;
  }
  return 1;
}

int tangent_size(StateKind kind) {
  const int ambient = ambient_size(kind);
  return ambient == 7 ? 6 : ambient;
}

bool Prior::holds(StateKey key) const {
  return std::any_of(blocks.begin(), blocks.end(), [&](const Block& block) { return block.key == key; });
}

}  // namespace cosight::vins
