#include "experiments/planar/wall_world.hpp"

#include <cmath>
#include <numbers>

namespace cosight::experiments {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180.0;

}  // namespace

WallWorld::WallWorld(unsigned seed, const WallWorldOptions& options)
    : options_(options), bearing_rng_(seed), stereo_rng_(seed + 1'000'003U) {
  std::mt19937_64 rng(seed + 2'000'003U);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const double margin = options.wall_distance;
  for (double x = -margin; x < options.path + margin; x += options.landmark_spacing) {
    landmarks_.emplace_back(x + 0.3 * options.landmark_spacing * unit(rng),
                            options.wall_distance + options.wall_relief * unit(rng));
  }
  sway_phase_ = kPi * unit(rng);
  turn_phase_ = kPi * unit(rng);
  camera_ = pose_at(0.0);
}

int WallWorld::steps() const {
  return static_cast<int>(std::lround(options_.duration / options_.dt));
}

/// Walking along the wall, not quite evenly and not quite straight, the axis within a few degrees of the
/// wall's normal.
PlanarPose WallWorld::pose_at(double t) const {
  constexpr double kSway = 0.15;           // [m]
  constexpr double kSurge = 0.25;          // [m]
  constexpr double kTurn = 4.0 * kDegree;  // [rad]
  const auto wave = [t](double period, double phase) { return std::sin(2.0 * kPi * t / period + phase); };
  const double x =
      options_.path * t / options_.duration + kSurge * (wave(11.0, sway_phase_) - std::sin(sway_phase_));
  const double z = kSway * (wave(7.0, turn_phase_) - std::sin(turn_phase_));
  return {{x, z}, 0.5 * kPi + kTurn * wave(9.0, turn_phase_ + sway_phase_)};
}

void WallWorld::step() {
  camera_ = pose_at(options_.dt * ++frame_);
}

std::vector<WallSighting> WallWorld::observe() {
  std::vector<WallSighting> seen;
  for (int i = 0; i < static_cast<int>(landmarks_.size()); ++i) {
    const Eigen::Vector2d to = landmarks_[static_cast<std::size_t>(i)] - camera_.p;
    const double bearing = std::remainder(std::atan2(to.y(), to.x()) - camera_.theta, 2.0 * kPi);
    if (std::abs(bearing) > 0.5 * options_.field_of_view_deg * kDegree) continue;
    WallSighting s;
    s.landmark = i;
    s.bearing = bearing + options_.bearing_sigma_deg * kDegree * bearing_noise_(bearing_rng_);
    s.stereo_bearing = bearing + options_.stereo_bearing_sigma_deg * kDegree * stereo_noise_(stereo_rng_);
    s.range = to.norm() + options_.range_sigma * stereo_noise_(stereo_rng_);
    seen.push_back(s);
  }
  return seen;
}

}  // namespace cosight::experiments
