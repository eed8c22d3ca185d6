#pragma once

#include <Eigen/Core>
#include <vector>

#include "shared/geometry/convex_polygon.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

struct CornerOptions {
  int fast_threshold = 12;     ///< gray levels; lower for dim or blurred images
  double min_score = 20.0;     ///< [(gray levels / px)^2] least eigenvalue; 0 is refused, too
  double min_distance = 12.0;  ///< [px] between corners, and to the occupied pixels
  int border = 10;             ///< [px] kept free along the image's edge
  int cell = 80;               ///< [px] the image is filled cell by cell, emptiest first
};

struct Corner {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< whole pixels
  double score = 0.0;                               ///< Shi and Tomasi's: the smaller eigenvalue
};

/// FAST proposes, Shi-Tomasi's eigenvalue judges, and a grid spreads the corners over the image.
class CornerDetector {
 public:
  explicit CornerDetector(const CornerOptions& options = {}) : options_(options) {}

  /// At most `max_corners`, the most wanted first: best of the cells with the fewest occupied pixels. Only
  /// inside `roi` when it is not null.
  std::vector<Corner> detect(const GrayImage& image, const std::vector<Eigen::Vector2d>& occupied,
                             int max_corners, const ConvexPolygon* roi = nullptr) const;

 private:
  CornerOptions options_;
};

/// Smaller eigenvalue of the structure tensor, the mean over 7x7 pixels of central differences. `x`, `y` at
/// least 4 px inside the image.
double shi_tomasi_score(const GrayImage& image, int x, int y);

}  // namespace cosight::vision
