#include "sim/city/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cosight::sim {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using Course = std::function<Pose(double)>;

constexpr double kLane = 3.4;  // width [m]

Eigen::Quaterniond yawed(double angle) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

/// A smooth step from 0 to 1 over u in [0, 1].
double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * (3.0 - 2.0 * u);
}

/// A place on the road, looking along it or against it.
Pose on_road(const Route& route, double s, double lateral, bool along) {
  return {yawed(route.heading(s) + (along ? 0.0 : pi)), route.beside(s, lateral, kGroundBelowCar)};
}

/// Ahead in the same lane: goes as the car itself will `gap` seconds later, so that both stop and start
/// together.
Course ahead(const Route& route, double gap, double room) {
  return [&route, gap, room](double t) { return on_road(route, route.distance(t + gap) + room, 0.0, true); };
}

/// Ahead as above, from t_0 to t_1, but overtakes the car to get there and drives away after it: nobody
/// appears or vanishes.
Course passing_by(const Route& route, double gap, double room, double t_0, double t_1) {
  return [&route, gap, room, t_0, t_1](double t) {
    constexpr double kBehind = 15.0;                        // [m]
    constexpr double kOvertakes = 9.0, kChangesLane = 3.0;  // [s]
    constexpr double kAway = 1.5;                           // [m/s^2]
    const double there = smooth((t - t_0) / kOvertakes);
    const double in_lane = smooth((t - t_0 - kOvertakes + kChangesLane) / kChangesLane);
    const double gone = std::max(0.0, t - t_1);
    const double s = (1.0 - there) * (route.distance(t) - kBehind) +
                     there * (route.distance(t + gap) + room) + 0.5 * kAway * gone * gone;
    return on_road(route, s, -kLane * (1.0 - in_lane), true);
  };
}

/// In the next lane, faster than the car by that share and beside it at t_0.
Course neighbour(const Route& route, double faster, double t_0) {
  return [&route, faster, t_0](double t) {
    return on_road(route, route.distance(t + faster * (t - t_0)), -kLane, true);
  };
}

/// Meets the car at t_0; its own speed is not quite constant.
Course oncoming(const Route& route, double v, double sway, double t_0) {
  return [&route, v, sway, t_0, s_0 = route.distance(t_0)](double t) {
    const double dt = t - t_0;
    return on_road(route, s_0 - v * dt + sway * std::sin(0.6 * dt), kLane, false);
  };
}

/// Comes towards the car and turns at s_0, from t_0 on, to its left (+1) or right (-1).
Course turning(const Route& route, double s_0, double v, double side, double t_0) {
  return [T_WT = on_road(route, s_0, kLane, false), v, side, t_0](double t) {
    constexpr double kRadius = 9.0;
    const double driven = v * (t - t_0);
    const double angle = std::clamp(driven / kRadius, 0.0, pi / 2.0);
    const double after = std::max(0.0, driven - kRadius * pi / 2.0);
    const Vector3d p(std::min(0.0, driven) + kRadius * std::sin(angle),
                     side * (kRadius * (1.0 - std::cos(angle)) + after), 0.0);
    return T_WT * Pose{yawed(side * angle), p};
  };
}

/// Straight across, `away` metres after s_0, before the car at t_0, to the left (+1) or right (-1).
Course crossing(const Route& route, double s_0, double away, double v, double side, double t_0) {
  return [T_WR = on_road(route, s_0, 0.0, true), away, v, side, t_0](double t) {
    return T_WR * Pose{yawed(side * pi / 2.0), Vector3d(away, side * v * (t - t_0), 0.0)};
  };
}

double time_at(const Route& route, double s) {
  double t = 0.0;
  while (route.distance(t) < s)
    t += 0.5;
  return t;
}

/// Draws who comes when.
class Traffic {
 public:
  Traffic(const Route& route, const TrafficOptions& options, std::mt19937_64& random)
      : route_(route), options_(options), random_(random), end_(route.duration()) {}

  std::vector<Vehicle> draw() {
    draw_ahead();
    at_random(options_.neighbours_per_minute, [this](double t) {
      const double faster = uniform(-0.25, 0.25);
      const double stays = options_.continuous ? std::clamp(6.0 / std::abs(faster), 15.0, 60.0) : 15.0;
      add(t - stays, t + stays, neighbour(route_, faster, t));
    });
    at_random(options_.oncoming_per_minute, [this, far = options_.continuous ? 12.0 : 8.0](double t) {
      add(t - far, t + 2.0, oncoming(route_, uniform(5.0, 12.0), uniform(0.0, 4.0), t));
    });
    at_random(options_.turning_per_minute, [this, more = options_.continuous ? 7.0 : 0.0](double t) {
      const double s_0 = route_.distance(t) + uniform(12.0, 25.0);
      add(t - 7.0 - more, t + 5.0 + more, turning(route_, s_0, uniform(3.5, 7.0), side(), t));
    });
    for (const Route::Corner& corner : route_.corners())
      draw_crossing(corner);
    return std::move(vehicles_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double side() { return uniform(0.0, 1.0) < 0.5 ? 1.0 : -1.0; }

  void at_random(double per_minute, const std::function<void(double)>& happen) {
    if (per_minute <= 0.0) return;
    std::exponential_distribution<double> gap(per_minute / 60.0);
    for (double t = gap(random_); t < end_; t += gap(random_))
      happen(t);
  }

  void draw_ahead() {
    double t = 0.0;
    while (t < end_) {
      const double stays = uniform(12.0, 40.0);
      const double room = uniform(6.0, 10.0);
      const double gap = uniform(0.8, 2.2);
      if (uniform(0.0, 1.0) < options_.ahead_share) add_ahead(gap, room, t, t + stays);
      t += stays;
    }
  }

  void add_ahead(double gap, double room, double from, double to) {
    constexpr double kGone = 13.0;  // [s]
    if (options_.continuous) return add(from, to + kGone, passing_by(route_, gap, room, from, to));
    add(from, to, ahead(route_, gap, room));
  }

  void draw_crossing(const Route::Corner& corner) {
    const double t = time_at(route_, corner.begin);
    const int count = std::poisson_distribution<int>(options_.crossing_per_corner)(random_);
    for (int i = 0; i < count; ++i) {
      const double t_0 = t - uniform(1.0, 9.0);
      const double to = side();
      const double away = to > 0.0 ? 12.0 : 16.0;
      const double stays = options_.continuous ? 12.0 : 6.0;
      add(t_0 - stays, t_0 + stays, crossing(route_, corner.begin, away, uniform(4.0, 9.0), to, t_0));
    }
  }

  void add(double from, double to, Course T_WV) {
    constexpr double kTextureOfACar = 45.0;
    constexpr double kTextureOfATruck = 100.0;
    const bool large = uniform(0.0, 1.0) < 0.2;
    Vehicle vehicle{from, to, std::move(T_WV), large ? Vector3d(9.0, 2.5, 3.2) : Vector3d(4.5, 1.8, 1.5), {}};
    const double texture = options_.texture * (large ? kTextureOfATruck : kTextureOfACar);
    for (int i = 0; i < static_cast<int>(texture); ++i)
      vehicle.points.push_back(point_on(vehicle.size));
    vehicles_.push_back(std::move(vehicle));
  }

  /// On one of the four upright faces; the ends, with lamps and plates, have as much texture as the sides.
  Vehicle::Point point_on(const Vector3d& size) {
    const int axis = uniform(0.0, 1.0) < 0.5 ? 0 : 1;
    const double end = 0.5 * side();
    Vehicle::Point point;
    point.normal_V = 2.0 * end * Vector3d::Unit(axis);
    point.p_V(axis) = end * size(axis);
    point.p_V(1 - axis) = uniform(-0.5, 0.5) * size(1 - axis);
    point.p_V.z() = uniform(0.3, size.z());
    return point;
  }

  const Route& route_;
  const TrafficOptions& options_;
  std::mt19937_64& random_;
  double end_;
  std::vector<Vehicle> vehicles_;
};

}  // namespace

bool Vehicle::hides(const Vector3d& eye_V, const Vector3d& p_V) const {
  const Vector3d low(-0.5 * size.x(), -0.5 * size.y(), 0.0);
  const Vector3d high(0.5 * size.x(), 0.5 * size.y(), size.z());
  double enter = 0.0;
  double leave = 0.999;  // what is on its own face is not behind it
  for (int axis = 0; axis < 3; ++axis) {
    const double along = p_V(axis) - eye_V(axis);
    if (std::abs(along) < 1e-9) {
      if (eye_V(axis) < low(axis) || eye_V(axis) > high(axis)) return false;
      continue;
    }
    const double a = (low(axis) - eye_V(axis)) / along;
    const double b = (high(axis) - eye_V(axis)) / along;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

std::vector<Vehicle> make_traffic(const Route& route, const TrafficOptions& options,
                                  std::mt19937_64& random) {
  return Traffic(route, options, random).draw();
}

}  // namespace cosight::sim
