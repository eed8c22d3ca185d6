#include "sim/city/route.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "shared/geometry/rotation.hpp"

namespace cosight::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kKnotStep = 0.25;      // [m]
constexpr double kBeyond = 600.0;       // [m] of road after the end, so that there is something to see
constexpr double kCornerSpeed = 4.5;    // [m/s]
constexpr double kCornerLength = 28.0;  // [m]
constexpr double kComfort = 1.3;        // mean acceleration [m/s^2]
constexpr double kPitchPerAcceleration = 0.006;  // [rad/(m/s^2)] the car nods
constexpr double kRollPerAcceleration = 0.008;   // [rad/(m/s^2)] and leans outwards

/// A smooth step 0 to 1 over u in [0, 1], its integral and its derivative.
double step(double u) {
  return u * u * u * (10.0 + u * (6.0 * u - 15.0));
}
double step_integral(double u) {
  return u * u * u * u * (2.5 + u * (u - 3.0));
}
double step_derivative(double u) {
  return 30.0 * u * u * (1.0 - u) * (1.0 - u);
}

double uniform(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

}  // namespace

Route::Route(double length, std::mt19937_64& random, const RouteOptions& options) : length_(length) {
  // Amplitudes as of a worn city road: long waves of the ground, bumps that shake the car.
  for (const auto& [amplitude, wavelength] : {std::pair{options.hills, 170.0}, {0.05, 24.0}, {0.008, 6.5}}) {
    waves_.push_back({amplitude, 2.0 * pi / wavelength, uniform(random, 0.0, 2.0 * pi)});
  }
  phases_.push_back({.duration = 2.0, .v_0 = options.start_speed, .v_1 = options.start_speed});
  int turned = 0;
  while (phases_.back().s < length) {
    drive_street(phases_.back().s + uniform(random, 120.0, 260.0), random);
    int side = uniform(random, 0.0, 1.0) < 0.5 ? 1 : -1;
    if (std::abs(turned + side) > 1) side = -side;
    turned += side;
    turn(side * pi / 2.0);
  }
  drive_street(length + kBeyond, random);
  tabulate_centre();
}

void Route::drive(double duration, double v) {
  const Phase& last = phases_.back();
  phases_.push_back({.t = last.t + last.duration,
                     .s = last.s + 0.5 * (last.v_0 + last.v_1) * last.duration,
                     .duration = duration,
                     .v_0 = last.v_1,
                     .v_1 = v});
}

void Route::drive_street(double until, std::mt19937_64& random) {
  constexpr double kBrakingRoom = 45.0;
  const auto reach = [this](double v) {
    drive(std::max(1.0, std::abs(v - phases_.back().v_1) / kComfort), v);
  };
  while (phases_.back().s < until - kBrakingRoom) {
    const double v = uniform(random, 8.0, 13.0);
    reach(v);
    drive(uniform(random, 2.0, 7.0), v);
    const double luck = uniform(random, 0.0, 1.0);
    if (luck < 0.25) {
      reach(0.0);
      drive(uniform(random, 3.0, 9.0), 0.0);
    } else if (luck < 0.6) {
      reach(0.5 * v);
    }
  }
  reach(kCornerSpeed);
}

void Route::turn(double angle) {
  drive(0.5, kCornerSpeed);
  const Phase& now = phases_.back();
  corners_.push_back({now.s + now.v_1 * now.duration, kCornerLength, angle});
  drive(kCornerLength / kCornerSpeed, kCornerSpeed);
  drive(0.5, kCornerSpeed);
}

double Route::duration() const {
  double low = 0.0;
  double high = phases_.back().t;
  while (high - low > 1e-3) {
    const double middle = 0.5 * (low + high);
    (distance(middle) < length_ ? low : high) = middle;
  }
  return high;
}

const Route::Phase& Route::phase(double t) const {
  const auto next =
      std::upper_bound(phases_.begin(), phases_.end(), t, [](double at, const Phase& p) { return at < p.t; });
  return next == phases_.begin() ? phases_.front() : *(next - 1);
}

double Route::distance(double t) const {
  const Phase& p = phase(t);
  const double u = std::clamp((t - p.t) / p.duration, 0.0, 1.0);
  const double after = std::max(0.0, t - p.t - p.duration);
  return p.s + p.duration * (p.v_0 * u + (p.v_1 - p.v_0) * step_integral(u)) + p.v_1 * after;
}

double Route::speed(double t) const {
  const Phase& p = phase(t);
  return p.v_0 + (p.v_1 - p.v_0) * step(std::clamp((t - p.t) / p.duration, 0.0, 1.0));
}

double Route::acceleration(double t) const {
  const Phase& p = phase(t);
  return (p.v_1 - p.v_0) / p.duration * step_derivative(std::clamp((t - p.t) / p.duration, 0.0, 1.0));
}

double Route::heading(double s) const {
  double psi = 0.0;
  for (const Corner& corner : corners_) {
    const double u = std::clamp((s - corner.begin) / corner.length, 0.0, 1.0);
    psi += corner.angle * (u - std::sin(2.0 * pi * u) / (2.0 * pi));
  }
  return psi;
}

double Route::curvature(double s) const {
  double kappa = 0.0;
  for (const Corner& corner : corners_) {
    const double u = std::clamp((s - corner.begin) / corner.length, 0.0, 1.0);
    kappa += corner.angle / corner.length * (1.0 - std::cos(2.0 * pi * u));
  }
  return kappa;
}

void Route::tabulate_centre() {
  knots_.emplace_back(Vector2d::Zero());
  const auto direction = [this](double s) { return Vector2d(std::cos(heading(s)), std::sin(heading(s))); };
  for (int k = 0; k * kKnotStep < length_ + kBeyond; ++k) {
    const double s = k * kKnotStep;
    knots_.push_back(knots_.back() +
                     kKnotStep / 6.0 *
                         (direction(s) + 4.0 * direction(s + 0.5 * kKnotStep) + direction(s + kKnotStep)));
  }
}

Vector2d Route::centre(double s) const {
  const double last = static_cast<double>(knots_.size() - 1);
  const double k = std::clamp(std::floor(s / kKnotStep), 0.0, last);
  const double from = k * kKnotStep;
  const double ds = s - from;
  const auto direction = [this](double at) { return Vector2d(std::cos(heading(at)), std::sin(heading(at))); };
  return knots_[static_cast<std::size_t>(k)] +
         ds / 6.0 * (direction(from) + 4.0 * direction(from + 0.5 * ds) + direction(s));
}

double Route::height(double s, int derivative) const {
  double sum = 0.0;
  for (const Wave& wave : waves_) {
    sum += wave.amplitude * std::pow(wave.wave_number, derivative) *
           std::sin(wave.wave_number * s + wave.phase + derivative * pi / 2.0);
  }
  return sum;
}

Vector3d Route::beside(double s, double lateral, double up) const {
  const double psi = heading(s);
  const Vector2d p = centre(s) + lateral * Vector2d(-std::sin(psi), std::cos(psi));
  return {p.x(), p.y(), height(s, 0) + up};
}

Pose Route::T_WB(double t) const {
  const double s = distance(t);
  const double v = speed(t);
  const double pitch = -std::atan(height(s, 1)) - kPitchPerAcceleration * acceleration(t);
  const double roll = kRollPerAcceleration * curvature(s) * v * v + 0.05 * height(0.7 * s, 1);
  return {Eigen::AngleAxisd(heading(s), Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Vector3d::UnitX()),
          beside(s, 0.0, 0.0)};
}

Vector3d Route::velocity_W(double t) const {
  const double s = distance(t);
  const double psi = heading(s);
  return speed(t) * Vector3d(std::cos(psi), std::sin(psi), height(s, 1));
}

Vector3d Route::acceleration_W(double t) const {
  const double s = distance(t);
  const double psi = heading(s);
  const double v = speed(t);
  const double a = acceleration(t);
  const double across = v * v * curvature(s);
  return {a * std::cos(psi) - across * std::sin(psi), a * std::sin(psi) + across * std::cos(psi),
          height(s, 2) * v * v + height(s, 1) * a};
}

Vector3d Route::body_rate(double t) const {
  constexpr double kStep = 1e-3;  // exact to 1e-6 rad/s for motions this slow
  return quaternion_log(T_WB(t - kStep).q.conjugate() * T_WB(t + kStep).q) / (2.0 * kStep);
}

}  // namespace cosight::sim
