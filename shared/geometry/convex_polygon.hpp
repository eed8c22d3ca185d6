#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosight {

/// Corners of a convex polygon, in the order in which x turns into y (positive area); fewer than three:
/// empty.
using ConvexPolygon = std::vector<Eigen::Vector2d>;

struct Rectangle {
  Eigen::Vector2d min = Eigen::Vector2d::Zero();
  Eigen::Vector2d max = Eigen::Vector2d::Zero();
};

/// The smallest convex polygon around `points`; collinear and repeated points are dropped. Empty when they
/// span no area.
ConvexPolygon convex_hull(std::vector<Eigen::Vector2d> points);

/// The part of `polygon` inside the rectangle; empty when there is none.
ConvexPolygon clip(const ConvexPolygon& polygon, const Rectangle& rectangle);

/// Inside or on the border.
bool contains(const ConvexPolygon& polygon, const Eigen::Vector2d& point);

double area(const ConvexPolygon& polygon);

/// Of a polygon that is not empty.
Rectangle bounding_box(const ConvexPolygon& polygon);

}  // namespace cosight
