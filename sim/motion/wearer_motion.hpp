#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "shared/geometry/pose.hpp"
#include "sim/motion/keyframes.hpp"
#include "sim/motion/path.hpp"

namespace cosight::sim {

/// How the wearer goes with the robot and where they look, over time.
struct WearerPlan {
  std::vector<Keyframe> ahead{};      ///< of the robot along its path [m]; negative: follows
  std::vector<Keyframe> left{};       ///< of the robot's path [m]
  std::vector<Keyframe> gaze_left{};  ///< of the path's direction [rad]
  std::vector<Keyframe> gaze_up{};    ///< [rad]
  std::vector<Keyframe> aside{};      ///< added to gaze_left [rad]
  double head_height = 1.65;          ///< of H, between the ears [m]
  double step_length = 0.7;           ///< [m]
  double bob = 0.02;                  ///< amplitude of the head's bob at full speed [m]
  double sway = 0.015;                ///< of its sway to the sides [m]
  double nod = 0.012;                 ///< of its pitch and roll [rad]
  double glance = 0.08;               ///< of the wandering of the eyes that the head follows [rad]
};

/// A person who walks along with the robot.
class WearerMotion {
 public:
  WearerMotion(WearerPlan plan, const Path& path, std::uint64_t seed);

  /// T_WH: between the ears, x where the face points, z up; `time` since the start [s].
  Pose head(double time) const;

  /// T_WP: the point on the floor under the body, x where the person walks.
  Pose feet(double time) const;

  /// Phase of the gait [rad]; two steps a turn.
  double gait(double time) const;

  /// Speed as a share of the path's full speed, 0 … 1 or a little more.
  double liveliness(double time) const;

  const WearerPlan& plan() const { return plan_; }
  void set_plan(WearerPlan plan) { plan_ = std::move(plan); }

 private:
  double length_at(double time) const;

  WearerPlan plan_;
  const Path& path_;
  double full_speed_ = 1.0;
  double phase_ = 0.0;
};

}  // namespace cosight::sim
