#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot_agent/vision/patch.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// Gauss-Newton on position, gain and offset: the pixel at which `patch` fits the image best, to a few
/// hundredths of a pixel on good texture. Nothing when it runs over a pixel away from `start`, has no unique
/// answer, or leaves the image.
std::optional<Eigen::Vector2d> align_patch(const GrayImage& image, const Patch& patch,
                                           const Eigen::Vector2d& start);

}  // namespace cosight::vision
