#include "experiments/urban_canyon/city_view.hpp"

#include <algorithm>

namespace cosight::experiments {

using Eigen::Vector2d;
using Eigen::Vector3d;

Pose CityView::T_BS() {
  Eigen::Matrix3d R_BS;
  R_BS << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  const Eigen::AngleAxisd nods(0.02, Vector3d::UnitX());
  return {Eigen::Quaterniond(R_BS) * nods, Vector3d(0.4, 0.1, 0.6)};
}

void CityView::go_to(double t) {
  constexpr double kFar = 90.0;  // a vehicle farther away shows nothing [m]
  s_ = route_.distance(t);
  T_WS_ = route_.T_WB(t) * T_BS();
  T_SW_ = T_WS_.inverse();
  near_.clear();
  for (std::size_t i = 0; i < traffic_.size(); ++i) {
    if (t < traffic_[i].from || t > traffic_[i].to) continue;
    const Pose T_WV = traffic_[i].T_WV(t);
    if ((T_WV.p - T_WS_.p).norm() > kFar) continue;
    near_.push_back({static_cast<int>(i), T_WV, T_WV.inverse() * T_WS_.p});
  }
}

const CityView::Near* CityView::near(int vehicle) const {
  const auto found = std::find_if(near_.begin(), near_.end(),
                                  [vehicle](const Near& other) { return other.vehicle == vehicle; });
  return found == near_.end() ? nullptr : &*found;
}

bool CityView::is_hidden(const Vector3d& p_W, int own_vehicle) const {
  return std::any_of(near_.begin(), near_.end(), [&](const Near& other) {
    return other.vehicle != own_vehicle &&
           traffic_[static_cast<std::size_t>(other.vehicle)].hides(other.eye_V, other.T_WV.inverse() * p_W);
  });
}

std::optional<Vector2d> CityView::project(const Vector3d& p_W) const {
  constexpr double kNearest = 2.0;  // [m]
  const Vector3d p_S = T_SW_ * p_W;
  if (p_S.z() < kNearest) return std::nullopt;
  const Vector2d uv(0.5 * kWidth + kFocalLength * p_S.x() / p_S.z(),
                    0.5 * kHeight + kFocalLength * p_S.y() / p_S.z());
  const bool inside = uv.x() > 0.0 && uv.y() > 0.0 && uv.x() < kWidth && uv.y() < kHeight;
  return inside ? std::optional(uv) : std::nullopt;
}

std::optional<Vector2d> CityView::see(const CityPoint& city_point) const {
  Vector3d p_W;
  if (city_point.moves()) {
    const Near* body = near(city_point.vehicle);
    if (body == nullptr) return std::nullopt;
    const Vehicle::Point& point =
        traffic_[static_cast<std::size_t>(city_point.vehicle)].points[city_point.point];
    if (point.normal_V.dot(body->eye_V - point.p_V) <= 0.0) return std::nullopt;
    p_W = body->T_WV * point.p_V;
  } else {
    const StreetPoint& point = street_[city_point.point];
    if (s_ < point.from || s_ > point.to) return std::nullopt;
    p_W = point.p_W;
  }
  const std::optional<Vector2d> uv = project(p_W);
  return uv && !is_hidden(p_W, city_point.vehicle) ? uv : std::nullopt;
}

std::vector<CityPoint> CityView::in_reach() const {
  std::vector<CityPoint> all;
  for (std::size_t i = 0; i < street_.size() && street_[i].from <= s_; ++i) {
    if (s_ <= street_[i].to) all.push_back({-1, i});
  }
  for (const Near& other : near_) {
    for (std::size_t i = 0; i < traffic_[static_cast<std::size_t>(other.vehicle)].points.size(); ++i)
      all.push_back({other.vehicle, i});
  }
  return all;
}

}  // namespace cosight::experiments
