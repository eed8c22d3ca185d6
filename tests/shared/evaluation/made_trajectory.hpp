#pragma once

#include <random>
#include <vector>

#include "shared/evaluation/association.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight {

inline Pose random_pose(std::mt19937& random, double position_range) {
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
  return {quaternion_exp(vector()), position_range * vector()};
}

/// A curve in space at 10 Hz, turning.
inline Trajectory spiral(std::size_t count) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    trajectory.push_back(
        {static_cast<Stamp>(i) * 100'000'000,
         {quaternion_exp({0.1 * t, 0.05, 0.3 * t}), {2.0 * std::cos(t), 2.0 * std::sin(t), 0.3 * t}}});
  }
  return trajectory;
}

inline Trajectory straight_line(std::size_t count, double step) {
  Trajectory trajectory;
  for (std::size_t i = 0; i < count; ++i) {
    trajectory.push_back({static_cast<Stamp>(i) * 100'000'000,
                          {Eigen::Quaterniond::Identity(), {step * static_cast<double>(i), 0.0, 0.0}}});
  }
  return trajectory;
}

inline Trajectory mapped(Trajectory trajectory, double scale, const Pose& T) {
  for (StampedPose& pose : trajectory) {
    pose.T_WC = {T.q * pose.T_WC.q, scale * (T.q * pose.T_WC.p) + T.p};
  }
  return trajectory;
}

inline std::vector<PosePair> pairs_of(const Trajectory& estimate, const Trajectory& truth) {
  std::vector<PosePair> pairs;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    pairs.push_back({truth[i].stamp, estimate[i].T_WC, truth[i].T_WC});
  }
  return pairs;
}

}  // namespace cosight
