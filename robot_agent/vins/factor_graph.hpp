#pragma once

#include <ceres/loss_function.h>

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "robot_agent/vins/adaptive_model.hpp"
#include "robot_agent/vins/distance_factor.hpp"
#include "robot_agent/vins/imu_factor.hpp"
#include "robot_agent/vins/prior_factor.hpp"
#include "robot_agent/vins/reprojection_factor.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

struct GraphOptions {
  double gravity = 9.81;              ///< [m/s^2]
  std::size_t min_observations = 4;   ///< fewer, and a landmark is left out
  bool estimate_extrinsics = false;   ///< refine T_BS; otherwise it is taken as exact
  bool estimate_time_offset = false;  ///< refine the camera's delay; otherwise it is taken as exact
  TrustOptions trust;
};

/// Which measurements a graph is made of.
enum class GraphScope {
  kWhole,        ///< the objective V20 / V31
  kOldestFrame,  ///< only what touches the oldest frame: what its marginalisation turns into a prior
  kPrior,        ///< only what is left of the past
};

/// The window as Ceres sees it: parameter arrays, and the factors between them. Not copyable: factors and
/// callers hold addresses into it. `window` must outlive it and its prior and increments stay as they are.
class FactorGraph {
 public:
  /// A sighting's factor. Blocks: pose of host, pose of target, extrinsics, landmark, time offset.
  struct VisualTerm {
    VisualTerm(const MovingSighting& first, const MovingSighting& now, double sqrt_information,
               const ceres::LossFunction* kernel, std::size_t index, std::size_t from, std::size_t to)
        : factor(first, now, sqrt_information), loss(kernel), landmark(index), host(from), target(to) {}

    ReprojectionFactor factor;
    const ceres::LossFunction* loss;  ///< may be null
    std::size_t landmark;             ///< index
    std::size_t host, target;         ///< slots
  };

  /// What a landmark's first sighting says, and with it that all its others follow.
  struct HostTerm {
    HostTerm(double sqrt_information, const ceres::LossFunction* kernel)
        : factor(sqrt_information), loss(kernel) {}

    HostFactor factor;
    const ceres::LossFunction* loss;  ///< may be null
    std::optional<DistanceFactor> distance = std::nullopt;
    const ceres::LossFunction* distance_loss = nullptr;
  };

  FactorGraph(const Window& window, const GraphOptions& options, GraphScope scope);
  FactorGraph(const FactorGraph&) = delete;
  FactorGraph& operator=(const FactorGraph&) = delete;
  ~FactorGraph() = default;

  double* block(StateKey key);
  double* landmark(std::size_t index) { return landmarks_[index].data(); }
  std::size_t landmark_count() const { return landmarks_.size(); }
  const HostTerm& host_term(std::size_t index) const { return hosts_[index]; }

  /// States that some factor touches and that are to be estimated, in a fixed order.
  std::vector<StateKey> free_states() const;
  bool is_constant(StateKind kind) const;

  /// Sorted by landmark.
  const std::deque<VisualTerm>& visual_terms() const { return visual_; }
  std::array<double*, 5> blocks(const VisualTerm& term);
  std::array<StateKey, 2> pose_keys(const VisualTerm& term) const;

  struct ImuTerm {
    ImuTerm(const Preintegration& imu, double gravity, std::size_t slot) : factor(imu, gravity), from(slot) {}

    ImuFactor factor;
    std::size_t from;  ///< slot; to the next one
  };
  const std::deque<ImuTerm>& imu_terms() const { return imu_; }
  std::array<StateKey, 4> keys(const ImuTerm& term) const;

  const PriorFactor* prior() const { return prior_ ? &*prior_ : nullptr; }
  std::vector<StateKey> prior_keys() const;

  /// Puts the parameters' present values back into the window this was made of.
  void write_back(Window& window) const;

 private:
  void add_visual_terms(GraphScope scope);
  void add_landmark(const Landmark& landmark);
  const ceres::LossFunction* loss(const Trust& trust);

  const Window& window_;
  GraphOptions options_;
  struct FrameBlocks {
    PoseBlock pose{};
    MotionBlock motion{};
  };
  PoseBlock& extrinsics() { return blocks_.back().pose; }
  const PoseBlock& extrinsics() const { return blocks_.back().pose; }
  double& time_offset() { return blocks_.back().motion[0]; }
  double time_offset() const { return blocks_.back().motion[0]; }

  /// Of the frames, then one more for extrinsics and time offset. In one piece, because Ceres takes
  /// parameters in the order of their addresses: sums would depend in their last digit on where the heap
  /// lies.
  std::vector<FrameBlocks> blocks_;
  std::vector<BodyTwist> twists_;  ///< of the frames; at rest where nothing depends on them
  std::vector<LandmarkBlock> landmarks_;
  std::deque<HostTerm> hosts_;  ///< one a landmark
  std::vector<FeatureId> landmark_ids_;
  std::deque<VisualTerm> visual_;
  std::deque<ImuTerm> imu_;
  std::optional<PriorFactor> prior_;
  std::vector<std::pair<Trust, std::unique_ptr<ceres::LossFunction>>> losses_;
};

}  // namespace cosight::vins
