#include "robot_agent/vins/rest.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

/// Median angle that features moved by in the image, from one frame to the other; nothing when too few are in
/// both.
std::optional<double> median_motion(const FeatureFrame& from, const FeatureFrame& to,
                                    std::size_t min_features) {
  std::map<FeatureId, Vector3d> before;
  for (const TrackedFeature& feature : from.features)
    before.emplace(feature.id, feature.sighting.bearing());
  std::vector<double> angles;
  for (const TrackedFeature& feature : to.features) {
    const auto seen = before.find(feature.id);
    if (seen != before.end()) angles.push_back((feature.sighting.bearing() - seen->second).norm());
  }
  if (angles.size() < std::max<std::size_t>(min_features, 1)) return std::nullopt;
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

}  // namespace

std::optional<Rest> find_rest(const std::deque<UnplacedFrame>& frames, const RestOptions& options) {
  if (frames.size() < 3) return std::nullopt;
  const auto motion = median_motion(frames.front().features, frames.back().features, options.min_features);
  if (!motion || *motion > options.max_motion) return std::nullopt;
  // The last frames may already have begun to move too little to be seen: the middle one has not.
  Rest rest{.stamp = frames[frames.size() / 2].features.stamp};
  std::size_t count = 0;
  for (const UnplacedFrame& frame : frames) {
    if (!frame.imu || frame.features.stamp > rest.stamp) continue;
    for (const ImuSample& sample : frame.imu->samples()) {
      rest.force_B += sample.acceleration_B;
      rest.angular_velocity_B += sample.angular_velocity_B;
      ++count;
    }
  }
  rest.force_B /= static_cast<double>(count);
  rest.angular_velocity_B /= static_cast<double>(count);
  return rest;
}

Eigen::Quaterniond levelled(const Vector3d& up_B) {
  const Eigen::Quaterniond level = Eigen::Quaterniond::FromTwoVectors(up_B, Vector3d::UnitZ());
  const Vector3d heading = level * Vector3d::UnitX();
  const Eigen::AngleAxisd unturn(-std::atan2(heading.y(), heading.x()), Vector3d::UnitZ());
  return (unturn * level).normalized();
}

NavState state_at(const Rest& rest, double gravity) {
  NavState state;
  state.T_WB.q = levelled(rest.force_B);
  state.bias.accelerometer = (1.0 - gravity / rest.force_B.norm()) * rest.force_B;
  state.bias.gyroscope = rest.angular_velocity_B;
  return state;
}

Prior rest_prior(const WindowFrame& first, const RestOptions& options, const StartUncertainty& otherwise,
                 double gravity) {
  StartUncertainty known = otherwise;
  known.velocity = options.velocity;
  known.gyroscope_bias = options.angular_velocity;
  Prior prior = start_prior(first, known);
  // force = R^T g + bias:  d force = [R^T g]x dtheta + d bias.
  const Vector3d up_B = first.state.T_WB.q.conjugate() * Vector3d(0.0, 0.0, gravity);
  const Eigen::Index rows = prior.J.rows();
  prior.J.conservativeResize(rows + 3, Eigen::NoChange);
  prior.J.bottomRows<3>().setZero();
  prior.J.block<3, 3>(rows, 3) = skew(up_B) / options.force;
  prior.J.block<3, 3>(rows, 9) = Eigen::Matrix3d::Identity() / options.force;
  prior.residual.conservativeResize(rows + 3);
  prior.residual.tail<3>().setZero();
  return prior;
}

}  // namespace cosight::vins
