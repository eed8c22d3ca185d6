#include "robot_agent/vins/factor_graph.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cosight::vins {

FactorGraph::FactorGraph(const Window& window, const GraphOptions& options, GraphScope scope)
    : window_(window), options_(options) {
  for (const WindowFrame& frame : window.frames) {
    blocks_.push_back({pose_block(frame.state.T_WB), motion_block(frame.state)});
  }
  twists_.resize(window.frames.size());
  if (options.estimate_time_offset || window.time_offset != 0.0) {
    for (std::size_t i = 0; i < twists_.size(); ++i)
      twists_[i] = window.twist(i);
  }
  blocks_.push_back({pose_block(window.T_BS), {window.time_offset}});
  if (!window.prior.empty()) prior_.emplace(window.prior);
  if (scope == GraphScope::kPrior) return;
  add_visual_terms(scope);
  const std::size_t last = scope == GraphScope::kWhole ? window.frames.size() : 2;
  for (std::size_t to = 1; to < last; ++to) {
    imu_.emplace_back(*window.frames[to].imu, options.gravity, to - 1);
  }
}

void FactorGraph::add_visual_terms(GraphScope scope) {
  for (const auto& [id, landmark] : window_.landmarks) {
    if (!window_.is_used(landmark, options_.min_observations)) continue;
    const bool from_oldest = landmark.observations.front().frame == window_.frames.front().id;
    if (scope == GraphScope::kOldestFrame && !from_oldest) continue;
    landmark_ids_.push_back(id);
    landmarks_.push_back({landmark.lambda, landmark.beside.x(), landmark.beside.y()});
    add_landmark(landmark);
  }
}

void FactorGraph::add_landmark(const Landmark& landmark) {
  const Observation& first = landmark.observations.front();
  const std::size_t host = window_.slot(first.frame);
  FeatureRecord feature{.times_tracked = landmark.times_tracked};
  if (window_.many_bend) feature.relative_misfit = landmark.misfit / window_.reference_misfit();
  feature.geometry_factor = window_.frames[host].geometry_factor;
  const Trust of_host = trust(options_.trust, feature);
  HostTerm& term = hosts_.emplace_back(of_host.sqrt_information, loss(of_host));
  if (landmark.known) {
    term.distance.emplace(*landmark.known);
    term.distance_loss = loss({.kernel = Kernel::kCauchy, .threshold = 1.0});
  }
  for (std::size_t k = 1; k < landmark.observations.size(); ++k) {
    const Observation& seen = landmark.observations[k];
    const std::size_t target = window_.slot(seen.frame);
    feature.geometry_factor = window_.frames[target].geometry_factor;
    const Trust how = trust(options_.trust, feature);
    visual_.emplace_back(MovingSighting{first.sighting, twists_[host]},
                         MovingSighting{seen.sighting, twists_[target]}, how.sqrt_information, loss(how),
                         landmarks_.size() - 1, host, target);
  }
}

const ceres::LossFunction* FactorGraph::loss(const Trust& how) {
  if (how.kernel == Kernel::kNone) return nullptr;
  for (const auto& [made_for, made] : losses_) {
    if (made_for.kernel == how.kernel && made_for.threshold == how.threshold) return made.get();
  }
  std::unique_ptr<ceres::LossFunction> made;
  if (how.kernel == Kernel::kCauchy) {
    made = std::make_unique<ceres::CauchyLoss>(how.threshold);
  } else {
    made = std::make_unique<ceres::HuberLoss>(how.threshold);
  }
  losses_.emplace_back(how, std::move(made));
  return losses_.back().second.get();
}

double* FactorGraph::block(StateKey key) {
  switch (key.kind) {
    case StateKind::kPose:
      return blocks_[window_.slot(key.frame)].pose.data();
    case StateKind::kMotion:
      return blocks_[window_.slot(key.frame)].motion.data();
    case StateKind::kExtrinsics:
      return extrinsics().data();
    case StateKind::kTimeOffset:
      break;
  }
  return &time_offset();
}

bool FactorGraph::is_constant(StateKind kind) const {
  return (kind == StateKind::kExtrinsics && !options_.estimate_extrinsics) ||
         (kind == StateKind::kTimeOffset && !options_.estimate_time_offset);
}

std::vector<StateKey> FactorGraph::free_states() const {
  std::set<StateKey> states;
  for (const VisualTerm& term : visual_) {
    const auto poses = pose_keys(term);
    states.insert(poses.begin(), poses.end());
  }
  if (!visual_.empty() && options_.estimate_extrinsics) states.insert({StateKind::kExtrinsics, 0});
  if (!visual_.empty() && options_.estimate_time_offset) states.insert({StateKind::kTimeOffset, 0});
  for (const ImuTerm& term : imu_) {
    const auto touched = keys(term);
    states.insert(touched.begin(), touched.end());
  }
  const std::vector<StateKey> remembered = prior_keys();
  states.insert(remembered.begin(), remembered.end());
  return {states.begin(), states.end()};
}

std::array<double*, 5> FactorGraph::blocks(const VisualTerm& term) {
  return {blocks_[term.host].pose.data(), blocks_[term.target].pose.data(), extrinsics().data(),
          landmarks_[term.landmark].data(), &time_offset()};
}

std::array<StateKey, 2> FactorGraph::pose_keys(const VisualTerm& term) const {
  return {StateKey{StateKind::kPose, window_.frames[term.host].id},
          StateKey{StateKind::kPose, window_.frames[term.target].id}};
}

std::array<StateKey, 4> FactorGraph::keys(const ImuTerm& term) const {
  const FrameId i = window_.frames[term.from].id;
  const FrameId j = window_.frames[term.from + 1].id;
  return {StateKey{StateKind::kPose, i}, StateKey{StateKind::kMotion, i}, StateKey{StateKind::kPose, j},
          StateKey{StateKind::kMotion, j}};
}

std::vector<StateKey> FactorGraph::prior_keys() const {
  std::vector<StateKey> keys;
  if (!prior_) return keys;
  for (const Prior::Block& block : window_.prior.blocks)
    keys.push_back(block.key);
  return keys;
}

void FactorGraph::write_back(Window& window) const {
  for (std::size_t i = 0; i < window.frames.size(); ++i) {
    window.frames[i].state = to_state(blocks_[i].pose.data(), blocks_[i].motion.data());
  }
  window.T_BS = to_pose(extrinsics().data());
  window.time_offset = time_offset();
  for (std::size_t l = 0; l < landmarks_.size(); ++l) {
    Landmark& landmark = window.landmarks[landmark_ids_[l]];
    landmark.lambda = landmarks_[l][0];
    landmark.beside = {landmarks_[l][1], landmarks_[l][2]};
  }
}

}  // namespace cosight::vins
