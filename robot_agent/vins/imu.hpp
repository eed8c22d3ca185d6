#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "shared/dataset/stamp.hpp"

namespace cosight::vins {

/// One inertial measurement in the body frame B (V4, V5): specific force, so that a unit at rest reads +g up.
struct ImuSample {
  Stamp stamp = 0;
  Eigen::Vector3d acceleration_B = Eigen::Vector3d::Zero();      ///< [m/s^2]
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// What the measurements have too much: a_hat = a + R_WB^T g_W + accelerometer, w_hat = w + gyroscope.
struct ImuBias {
  Eigen::Vector3d accelerometer = Eigen::Vector3d::Zero();  ///< [m/s^2]
  Eigen::Vector3d gyroscope = Eigen::Vector3d::Zero();      ///< [rad/s]
};

/// Continuous-time noise densities. The paper's Table 1 gives the standard deviation of one 200 Hz sample
/// (0.1, 0.01, 0.001, 0.0001, as VINS-Mono means them); times sqrt(5 ms) these are the defaults here.
struct ImuNoise {
  double accelerometer = 7.07e-3;       ///< [m/s^2/sqrt(Hz)]
  double gyroscope = 7.07e-4;           ///< [rad/s/sqrt(Hz)]
  double accelerometer_walk = 7.07e-5;  ///< [m/s^3/sqrt(Hz)]
  double gyroscope_walk = 7.07e-6;      ///< [rad/s^2/sqrt(Hz)]
};

/// The measurements that no frame has used yet, in the order of their stamps.
class ImuBuffer {
 public:
  /// False, and nothing kept, when the sample is not newer than the last one or not finite. A last one that
  /// was more than a second ahead of all others goes instead.
  bool push(const ImuSample& sample);

  bool covers(Stamp from, Stamp to) const;

  /// Longest time between two neighbouring samples anywhere in (from, to] [s]. Needs covers(from, to).
  double longest_gap(Stamp from, Stamp to) const;

  /// The samples in [from, to], with the first and the last interpolated to these very instants, so that
  /// spans that follow each other leave no gap. Needs covers(from, to) and from < to.
  std::vector<ImuSample> between(Stamp from, Stamp to) const;

  /// Forgets what is older than `stamp`, except the one sample that interpolation at `stamp` needs.
  void drop_before(Stamp stamp);

  void clear() { samples_.clear(); }
  bool empty() const { return samples_.empty(); }

 private:
  ImuSample at(Stamp stamp) const;
  bool last_is_ahead_of(Stamp stamp) const;

  std::deque<ImuSample> samples_;
};

}  // namespace cosight::vins
