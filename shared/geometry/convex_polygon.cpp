#include "shared/geometry/convex_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cosight {
namespace {

using Vector2 = Eigen::Vector2d;

double cross(const Vector2& a, const Vector2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool turns_left(const Vector2& a, const Vector2& b, const Vector2& c) {
  return cross(b - a, c - b) > 0.0;
}

/// On a grid far finer than anything measured, so that points on one line that rounding moved apart sort
/// along the line and not by their rounding errors.
Vector2 on_grid(const Vector2& point) {
  constexpr double kStep = 1e-9;
  return {std::nearbyint(point.x() / kStep) * kStep, std::nearbyint(point.y() / kStep) * kStep};
}

/// One side of the convex chain over points sorted by x (Andrew's monotone chain), its last point left out.
template <class Iterator>
void append_chain(Iterator begin, Iterator end, ConvexPolygon& hull) {
  const std::size_t base = hull.size();
  for (Iterator point = begin; point != end; ++point) {
    while (hull.size() >= base + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *point))
      hull.pop_back();
    hull.push_back(*point);
  }
  hull.pop_back();
}

/// Sutherland-Hodgman against normal . p <= offset.
ConvexPolygon clip_half_plane(const ConvexPolygon& polygon, const Vector2& normal, double offset) {
  ConvexPolygon kept;
  kept.reserve(polygon.size() + 1);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    const double excess_a = normal.dot(a) - offset;
    const double excess_b = normal.dot(b) - offset;
    if (excess_a <= 0.0) kept.push_back(a);
    if ((excess_a < 0.0 && excess_b > 0.0) || (excess_a > 0.0 && excess_b < 0.0)) {
      kept.push_back(a + excess_a / (excess_a - excess_b) * (b - a));
    }
  }
  return kept;
}

}  // namespace

ConvexPolygon convex_hull(std::vector<Eigen::Vector2d> points) {
  for (Vector2& point : points)
    point = on_grid(point);
  std::sort(points.begin(), points.end(), [](const Vector2& a, const Vector2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  ConvexPolygon hull;
  if (points.size() < 3) return hull;
  hull.reserve(points.size() + 1);
  append_chain(points.begin(), points.end(), hull);
  append_chain(points.rbegin(), points.rend(), hull);
  if (hull.size() < 3) hull.clear();
  return hull;
}

ConvexPolygon clip(const ConvexPolygon& polygon, const Rectangle& rectangle) {
  ConvexPolygon kept = polygon;
  for (int axis = 0; axis < 2; ++axis) {
    Vector2 normal = Vector2::Zero();
    normal(axis) = 1.0;
    kept = clip_half_plane(kept, normal, rectangle.max(axis));
    kept = clip_half_plane(kept, -normal, -rectangle.min(axis));
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

bool contains(const ConvexPolygon& polygon, const Eigen::Vector2d& point) {
  if (polygon.size() < 3) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2& a = polygon[i];
    const Vector2& b = polygon[(i + 1) % polygon.size()];
    if (cross(b - a, point - a) < -1e-9 * (b - a).norm()) return false;
  }
  return true;
}

double area(const ConvexPolygon& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

Rectangle bounding_box(const ConvexPolygon& polygon) {
  Rectangle box{polygon.front(), polygon.front()};
  for (const Vector2& corner : polygon) {
    box.min = box.min.cwiseMin(corner);
    box.max = box.max.cwiseMax(corner);
  }
  return box;
}

}  // namespace cosight
