#include "robot_agent/vision/align_patch.hpp"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstddef>

#include "robot_agent/vision/index.hpp"

namespace cosight::vision {
namespace {

using GrayLevels = std::array<float, std::size_t{Patch::kStride} * Patch::kMaxSide>;

/// The window around `pixel`, bilinear; one pair of weights for all, since they share the fraction. Relative
/// to the patch's mean, so that small numbers are summed. False when it does not lie in the image.
bool sample_window(const GrayImage& image, const Eigen::Vector2d& pixel, int side, int mean,
                   GrayLevels& window) {
  const int left = static_cast<int>(std::floor(pixel.x())) - side / 2;
  const int top = static_cast<int>(std::floor(pixel.y())) - side / 2;
  if (left < 0 || top < 0 || left + side >= image.width || top + side >= image.height) return false;
  const auto fx = static_cast<float>(pixel.x() - std::floor(pixel.x()));
  const auto fy = static_cast<float>(pixel.y() - std::floor(pixel.y()));
  const float w00 = (1.0F - fx) * (1.0F - fy);
  const float w10 = fx * (1.0F - fy);
  const float w01 = (1.0F - fx) * fy;
  const float w11 = fx * fy;
  for (int r = 0; r < side; ++r) {
    const std::uint8_t* upper = image.row(top + r) + left;
    const std::uint8_t* lower = image.row(top + r + 1) + left;
    float* to = window.data() + static_cast<std::ptrdiff_t>(r) * Patch::kStride;
    for (int c = 0; c < side; ++c) {
      to[c] = w00 * static_cast<float>(upper[c]) + w10 * static_cast<float>(upper[c + 1]) +
              w01 * static_cast<float>(lower[c]) + w11 * static_cast<float>(lower[c + 1]) -
              static_cast<float>(mean);
    }
  }
  return true;
}

}  // namespace

// patch = a w + b + a (w_x dx + w_y dy), linear in [a dx, a dy, a, b]; w is the window at the present pixel.
std::optional<Eigen::Vector2d> align_patch(const GrayImage& image, const Patch& patch,
                                           const Eigen::Vector2d& start) {
  constexpr int kMaxIterations = 5;
  constexpr double kConverged = 0.01;
  constexpr double kMaxDrift = 1.0;
  Eigen::Vector2d pixel = start;
  GrayLevels w;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (!sample_window(image, pixel, patch.side, patch.mean, w)) return std::nullopt;
    Eigen::Matrix4f A = Eigen::Matrix4f::Zero();
    Eigen::Vector4f y = Eigen::Vector4f::Zero();
    for (int r = 1; r + 1 < patch.side; ++r) {
      for (int c = 1; c + 1 < patch.side; ++c) {
        const auto i = index(r * Patch::kStride + c);
        const Eigen::Vector4f row(0.5F * (w[i + 1] - w[i - 1]),
                                  0.5F * (w[i + Patch::kStride] - w[i - Patch::kStride]), w[i], 1.0F);
        A += row * row.transpose();
        y += static_cast<float>(patch.deviations[i]) * row;
      }
    }
    const Eigen::Vector4d solution = A.cast<double>().ldlt().solve(y.cast<double>());
    if (!(solution(2) > 0.1)) return std::nullopt;  // no likeness, or a negative
    const Eigen::Vector2d step = solution.head<2>() / solution(2);
    pixel += step;
    if (!((pixel - start).norm() <= kMaxDrift)) return std::nullopt;
    if (step.norm() < kConverged) return pixel;
  }
  return pixel;
}

}  // namespace cosight::vision
