#include "experiments/urban_canyon/street.hpp"

#include <algorithm>
#include <cmath>

namespace cosight::experiments {
namespace {

using Eigen::Vector3d;

/// Points along the road, on both of its sides.
struct Row {
  double per_metre = 1.0;
  double lateral_low = 0.0, lateral_high = 0.0;  ///< from the middle of the road [m]
  double height_low = 0.0, height_high = 0.0;    ///< above B [m]
  double reach = 150.0;                          ///< seen from so far [m]
};

constexpr Row kFronts{2.2, 11.0, 18.0, 0.0, 22.0, 150.0};
constexpr Row kKerb{0.15, 5.5, 9.0, -0.6, 4.0, 90.0};
constexpr Row kRoad{0.04, 0.0, 7.0, -0.9, -0.9, 35.0};
constexpr Row kTowers{0.2, 30.0, 120.0, 20.0, 110.0, 400.0};

class Street {
 public:
  Street(const Route& route, std::mt19937_64& random) : route_(route), random_(random) {}

  std::vector<StreetPoint> draw() {
    for (const Row& row : {kFronts, kKerb, kRoad, kTowers})
      draw_row(row);
    for (const Route::Corner& corner : route_.corners())
      draw_end(corner);
    std::sort(points_.begin(), points_.end(),
              [](const StreetPoint& a, const StreetPoint& b) { return a.from < b.from; });
    return std::move(points_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// From where the view along the streets reaches a point that stands beside the road at `s`: houses stand
  /// between it and a street of another direction.
  double first_sight(double s, double reach) const {
    constexpr double kStep = 2.0;
    constexpr double kAroundTheCorner = 0.7;  // [rad]
    double from = s;
    while (from > s - reach && std::abs(route_.heading(from) - route_.heading(s)) < kAroundTheCorner)
      from -= kStep;
    return from;
  }

  void draw_row(const Row& row) {
    constexpr double kBefore = 5.0;
    constexpr double kBeyond = 400.0;
    std::exponential_distribution<double> gap(2.0 * row.per_metre);
    for (double s = -kBefore; s < route_.length() + kBeyond; s += gap(random_)) {
      const double side = uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0;
      const double lateral = side * uniform(row.lateral_low, row.lateral_high);
      const double height = uniform(row.height_low, row.height_high);
      points_.push_back({route_.beside(s, lateral, height), first_sight(s, row.reach), s + kBefore});
    }
  }

  /// The house at the end of a street that turns.
  void draw_end(const Route::Corner& corner) {
    constexpr int kPoints = 60;
    const double psi = route_.heading(corner.begin);
    for (int i = 0; i < kPoints; ++i) {
      const double across = uniform(-22.0, 22.0);
      const double ahead = corner.length + uniform(4.0, 8.0);
      const Vector3d offset(ahead * std::cos(psi) - across * std::sin(psi),
                            ahead * std::sin(psi) + across * std::cos(psi), uniform(0.0, 20.0));
      points_.push_back({route_.beside(corner.begin, 0.0, 0.0) + offset, first_sight(corner.begin, 150.0),
                         corner.begin + 0.7 * corner.length});
    }
  }

  const Route& route_;
  std::mt19937_64& random_;
  std::vector<StreetPoint> points_;
};

}  // namespace

std::vector<StreetPoint> make_street(const Route& route, std::mt19937_64& random) {
  return Street(route, random).draw();
}

}  // namespace cosight::experiments
