#include "robot_agent/vins/sliding_window.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "robot_agent/vins/marginalisation.hpp"
#include "robot_agent/vins/parameter_blocks.hpp"
#include "robot_agent/vins/triangulation.hpp"

namespace cosight::vins {
namespace {

Eigen::VectorXd ambient(const auto& block) {
  return Eigen::Map<const Eigen::VectorXd>(block.data(), static_cast<Eigen::Index>(block.size()));
}

bool is_tracked(const Landmark& landmark, FrameId newest) {
  return !landmark.observations.empty() && landmark.observations.back().frame == newest;
}

/// The landmark goes on without its first `count` sightings, from the next one's frame; its depth moves
/// along.
void lose_first(Landmark& landmark, std::size_t count, const Window& window) {
  const Pose T_WS_old = window.T_WS(window.slot(landmark.observations.front().frame));
  const Eigen::Vector3d ray = window.ray(landmark);
  landmark.observations.erase(landmark.observations.begin(),
                              landmark.observations.begin() + static_cast<std::ptrdiff_t>(count));
  if (landmark.observations.empty()) return;
  const Pose T_WS_new = window.T_WS(window.slot(landmark.observations.front().frame));
  const Pose T = T_WS_new.inverse() * T_WS_old;
  if (landmark.known) landmark.known = seen_from(*landmark.known, ray, T);
  if (!landmark.has_depth) return;
  // Times lambda, as in the reprojection factor.
  const Eigen::Vector3d h = T.q * ray + landmark.lambda * T.p;
  const Eigen::Vector3d seen = landmark.observations.front().sighting.bearing();
  landmark.has_depth = h.dot(seen) > 0.0;
  landmark.lambda /= h.norm();
  landmark.beside = tangent_basis(seen) * (h / h.dot(seen));
}

/// How many of its sightings a landmark gives away when its host goes. One that is followed on keeps enough
/// to stay in use; how many differs from landmark to landmark, so that not all lose their baselines at once.
std::size_t given_away(FeatureId id, const Landmark& landmark, FrameId newest) {
  constexpr std::size_t kLeast = 2;
  const std::size_t count = landmark.observations.size();
  if (!is_tracked(landmark, newest)) return count;
  if (count < 2 * kLeast) return 1;
  const FeatureId scattered = id * 2654435761U >> 7U;  // Knuth's hash
  return kLeast + scattered % (count - 2 * kLeast + 1);
}

/// What the landmarks of the oldest frame keep for themselves when it goes; taken out of the window. A
/// sighting is either in the prior or still in the window, never in both: it would count twice, and the
/// window would believe its shape too much.
std::map<FeatureId, std::vector<Observation>> set_aside(Window& window) {
  const FrameId oldest = window.frames.front().id;
  const FrameId newest = window.frames.back().id;
  std::map<FeatureId, std::vector<Observation>> kept;
  for (auto& [id, landmark] : window.landmarks) {
    if (landmark.observations.front().frame != oldest) continue;
    const auto first_kept =
        landmark.observations.begin() + static_cast<std::ptrdiff_t>(given_away(id, landmark, newest));
    kept.emplace(id, std::vector<Observation>(first_kept, landmark.observations.end()));
    landmark.observations.erase(first_kept, landmark.observations.end());
  }
  return kept;
}

void erase_unseen(Window& window) {
  std::erase_if(window.landmarks, [](const auto& entry) { return entry.second.observations.empty(); });
}

void slide_oldest(Window& window, const GraphOptions& options) {
  const auto kept = set_aside(window);
  window.prior = marginalise_oldest(window, options);
  for (const auto& [id, observations] : kept) {
    Landmark& landmark = window.landmarks.at(id);
    const std::size_t given = landmark.observations.size();
    landmark.observations.insert(landmark.observations.end(), observations.begin(), observations.end());
    landmark.known.reset();  // it is in the prior now
    lose_first(landmark, given, window);
  }
  window.frames.pop_front();
  window.frames.front().imu.reset();
  erase_unseen(window);
}

void slide_second_newest(Window& window, const GraphOptions& options) {
  const std::size_t slot = window.frames.size() - 2;
  const FrameId gone = window.frames[slot].id;
  window.prior = marginalise_frame(window, options, gone);
  for (auto& [id, landmark] : window.landmarks) {
    if (landmark.observations.front().frame == gone) {
      lose_first(landmark, 1, window);
    } else {
      std::erase_if(landmark.observations, [gone](const Observation& seen) { return seen.frame == gone; });
    }
  }
  Preintegration joined = std::move(*window.frames[slot].imu);
  joined.append(*window.frames[slot + 1].imu);
  window.frames[slot + 1].imu = std::move(joined);
  window.frames.erase(window.frames.begin() + static_cast<std::ptrdiff_t>(slot));
  erase_unseen(window);
}

}  // namespace

Prior start_prior(const WindowFrame& first, const StartUncertainty& uncertainty) {
  Prior prior;
  prior.blocks.push_back({{StateKind::kPose, first.id}, ambient(pose_block(first.state.T_WB))});
  prior.blocks.push_back({{StateKind::kMotion, first.id}, ambient(motion_block(first.state))});
  prior.residual = Eigen::VectorXd::Zero(kPoseDim + kMotionDim);
  prior.J = Eigen::MatrixXd::Zero(kPoseDim + kMotionDim, kPoseDim + kMotionDim);
  prior.J.diagonal().segment<3>(0).setConstant(1.0 / uncertainty.position);
  // Tilt and yaw are turns about the axes of W; the pose's tangent is in B: theta_W = R_WB theta_B.
  const Eigen::Vector3d tilt_and_yaw(1.0 / uncertainty.tilt, 1.0 / uncertainty.tilt, 1.0 / uncertainty.yaw);
  prior.J.block<3, 3>(3, 3) = tilt_and_yaw.asDiagonal() * first.state.T_WB.q.toRotationMatrix();
  prior.J.diagonal().segment<3>(6).setConstant(1.0 / uncertainty.velocity);
  prior.J.diagonal().segment<3>(9).setConstant(1.0 / uncertainty.accelerometer_bias);
  prior.J.diagonal().segment<3>(12).setConstant(1.0 / uncertainty.gyroscope_bias);
  return prior;
}

void append_frame(Window& window, const FeatureFrame& frame, Preintegration imu, double gravity) {
  const WindowFrame& before = window.frames.back();
  WindowFrame next;
  next.id = before.id + 1;
  next.stamp = frame.stamp;
  next.state = imu.propagate(before.state, gravity);
  next.imu = std::move(imu);
  window.frames.push_back(std::move(next));
  window.add_observations(frame);
}

void update_geometry_factors(Window& window) {
  std::vector<std::vector<Eigen::Vector3d>> directions(window.frames.size());
  for (const auto& [id, landmark] : window.landmarks) {
    if (!landmark.has_depth) continue;
    for (const Observation& seen : landmark.observations) {
      directions[window.slot(seen.frame)].push_back(seen.sighting.bearing());
    }
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    window.frames[i].geometry_factor = geometry_factor(directions[i]);
  }
}

int drop_failed_landmarks(Window& window, const WindowOptions& options) {
  const FrameId newest = window.frames.back().id;
  int dropped = 0;
  for (auto& [id, landmark] : window.landmarks) {
    if (!landmark.has_depth || landmark.lambda > -options.max_behind) continue;
    ++dropped;
    const bool tracked = is_tracked(landmark, newest);
    landmark.observations.erase(landmark.observations.begin(),
                                landmark.observations.end() - (tracked ? 1 : 0));
    landmark.has_depth = false;
    landmark.beside.setZero();
  }
  erase_unseen(window);
  return dropped;
}

void slide(Window& window, bool second_newest_is_keyframe, const WindowOptions& options) {
  if (second_newest_is_keyframe) {
    slide_oldest(window, options.solver.graph);
  } else {
    slide_second_newest(window, options.solver.graph);
  }
}

void repropagate_where_needed(Window& window, const WindowOptions& options) {
  for (std::size_t to = 1; to < window.frames.size(); ++to) {
    Preintegration& imu = *window.frames[to].imu;
    const ImuBias& now = window.frames[to - 1].state.bias;
    const bool far = (now.gyroscope - imu.bias().gyroscope).norm() > options.max_gyroscope_change ||
                     (now.accelerometer - imu.bias().accelerometer).norm() > options.max_accelerometer_change;
    if (far) imu.repropagate(now);
  }
}

}  // namespace cosight::vins
