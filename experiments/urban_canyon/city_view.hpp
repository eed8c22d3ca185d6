#pragma once

#include <Eigen/Core>
#include <compare>
#include <optional>
#include <vector>

#include "experiments/urban_canyon/street.hpp"
#include "sim/city/traffic.hpp"

namespace cosight::experiments {

using sim::TrafficOptions;
using sim::Vehicle;

/// A point that a camera can follow: of something still, or of a vehicle.
struct CityPoint {
  int vehicle = -1;  ///< index; -1: stands still
  std::size_t point = 0;

  bool moves() const { return vehicle >= 0; }
  auto operator<=>(const CityPoint&) const = default;
};

/// What a camera in the car sees of the city. 752 x 480 pixels, f = 460, no distortion. Has its own
/// projection.
class CityView {
 public:
  static constexpr double kWidth = 752.0, kHeight = 480.0, kFocalLength = 460.0;  // [px]

  CityView(const Route& route, const std::vector<StreetPoint>& street, const std::vector<Vehicle>& traffic)
      : route_(route), street_(street), traffic_(traffic) {}

  /// S: x right, y down, z forward.
  static Pose T_BS();

  void go_to(double t);

  /// Where a point is in the image [px]; nothing when it is outside, turned away or hidden behind a vehicle.
  std::optional<Eigen::Vector2d> see(const CityPoint& city_point) const;

  /// All points that may be in view.
  std::vector<CityPoint> in_reach() const;

 private:
  struct Near {
    int vehicle = 0;
    Pose T_WV;
    Eigen::Vector3d eye_V;
  };

  const Near* near(int vehicle) const;
  bool is_hidden(const Eigen::Vector3d& p_W, int own_vehicle) const;
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_W) const;

  const Route& route_;
  const std::vector<StreetPoint>& street_;
  const std::vector<Vehicle>& traffic_;
  double s_ = 0.0;
  Pose T_WS_, T_SW_;
  std::vector<Near> near_;
};

}  // namespace cosight::experiments
