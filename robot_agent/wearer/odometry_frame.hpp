#pragma once

#include <cstdint>
#include <deque>

#include "shared/dataset/sample.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::wearer {

/// The robot's body B in a level frame O that drifts and never jumps: O is B where the odometry began. Gaps
/// of the odometry and steps in it (a restart) are joined as if the robot had stood still meanwhile.
class OdometryFrame {
 public:
  static constexpr Stamp kMaxGap = kNanosecondsPerSecond / 2;  ///< nothing is said about longer ones

  /// Not finite, or not newer than the last one: counted and left out.
  void add(const WheelOdometrySample& sample);

  /// T_OB at `stamp`: between the samples, and a little beyond the last one with its speed. Identity before
  /// the first one, the last pose long after the last one.
  Pose T_OB(Stamp stamp) const;

  /// False when the motion about `stamp` is a guess.
  bool knows(Stamp stamp) const;

  std::uint64_t refused() const { return refused_; }
  std::uint64_t jumps() const { return jumps_; }

 private:
  struct Row {
    Stamp stamp = 0;
    Pose T_OB;
    double speed = 0.0, turn_rate = 0.0;
  };

  bool continues(const Row& last, const WheelOdometrySample& sample, const Pose& T_OB) const;

  Pose T_OR_;  ///< R: the frame that the wheels count from
  std::deque<Row> rows_;
  std::uint64_t refused_ = 0;
  std::uint64_t jumps_ = 0;
};

}  // namespace cosight::wearer
