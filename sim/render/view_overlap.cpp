#include "sim/render/view_overlap.hpp"

namespace cosight::sim {
namespace {

constexpr int kColumns = 16;
constexpr int kRows = 10;

bool is_seen(std::span<const Quad> building, const Eigen::Vector3d& p_W, const Camera& B, const Pose& T_WB) {
  const std::optional<Eigen::Vector2d> pixel = B.pixel_of(T_WB.inverse() * p_W);
  if (!pixel || !B.calibration().contains(*pixel)) return false;
  const std::optional<Hit> hit = cast_ray(building, T_WB.p, p_W - T_WB.p);
  return hit && hit->range > 0.99;
}

}  // namespace

double seen_by_both(std::span<const Quad> building, const Camera& A, const Pose& T_WA, const Camera& B,
                    const Pose& T_WB) {
  int seen = 0;
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      const Eigen::Vector2d pixel((column + 0.5) / kColumns * A.calibration().width,
                                  (row + 0.5) / kRows * A.calibration().height);
      const Eigen::Vector3d direction = T_WA.q * A.ray_through(pixel).homogeneous();
      const std::optional<Hit> hit = cast_ray(building, T_WA.p, direction);
      if (hit && is_seen(building, T_WA.p + hit->range * direction, B, T_WB)) ++seen;
    }
  }
  return static_cast<double>(seen) / (kColumns * kRows);
}

}  // namespace cosight::sim
