#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "robot_agent/vins/distance_factor.hpp"
#include "robot_agent/vins/nav_state.hpp"
#include "robot_agent/vins/parameter_blocks.hpp"
#include "robot_agent/vins/preintegration.hpp"
#include "robot_agent/vins/prior.hpp"
#include "robot_agent/vins/reprojection_factor.hpp"

namespace cosight::vins {

using FeatureId = std::uint64_t;

/// A feature that the front end followed into a frame.
struct TrackedFeature {
  FeatureId id = 0;
  Sighting sighting;
  std::optional<KnownDistance> distance = std::nullopt;
};

/// One frame as the window gets it: features in the undistorted image plane.
struct FeatureFrame {
  Stamp stamp = 0;
  std::vector<TrackedFeature> features;
};

struct Observation {
  FrameId frame = 0;
  Sighting sighting;
  int times_tracked = 1;  ///< N when this frame saw it, itself included
};

/// A point seen from several frames of the window; its state is a bearing near its first
/// sighting and the inverse distance along it.
struct Landmark {
  std::vector<Observation> observations;             ///< in the order of the frames; the first is the host
  double lambda = 0.0;                               ///< [1/m]
  Eigen::Vector2d beside = Eigen::Vector2d::Zero();  ///< of the first sighting, see LandmarkBlock [rad]
  bool has_depth = false;
  int times_tracked = 0;  ///< N: frames that ever saw it, also those that left the window
  double misfit = 0.0;    ///< see misfit.hpp [rad]; zero: not known
  std::optional<KnownDistance> known = std::nullopt;  ///< from its host, by others than this window
};

struct WindowFrame {
  FrameId id = 0;
  Stamp stamp = 0;
  NavState state;
  std::optional<Preintegration> imu;  ///< from the frame before; nothing in the first
  double geometry_factor = 0.0;       ///< g (V25); zero: not known
};

/// The sliding window (V1-V3): what is estimated, what was measured, and what is left of the past.
struct Window {
  std::deque<WindowFrame> frames;
  std::map<FeatureId, Landmark> landmarks;
  Pose T_BS;                    ///< camera in the body
  double time_offset = 0.0;     ///< image stamp + time_offset is the IMU's clock [s]
  double typical_misfit = 0.0;  ///< median over the landmarks [rad]; zero: not known
  double usual_misfit = 0.0;    ///< the same as it is mostly, see misfit.hpp [rad]; zero: not known
  bool many_bend = false;       ///< see watch_for_movers()
  Prior prior;

  std::size_t slot(FrameId id) const;  ///< position in `frames` of a frame that is there

  /// How the body moves when a frame's stamp says: its own velocity, and what the gyroscope read about then.
  BodyTwist twist(std::size_t slot) const;
  /// The camera when the frame was really taken, `time_offset` later than its stamp says.
  Pose T_WS(std::size_t slot) const;

  /// Unit vector towards a landmark in the axes of the camera that saw it first.
  Eigen::Vector3d ray(const Landmark& landmark) const {
    return host_bearing(landmark.observations.front().sighting, landmark.beside);
  }

  /// Adds the observations of the newest frame, which must already be in `frames`.
  void add_observations(const FeatureFrame& frame);

  /// What a landmark's misfit is measured against: the typical one, or the usual one where most landmarks are
  /// on vehicles [rad].
  double reference_misfit() const { return std::min(typical_misfit, usual_misfit); }

  /// Seen often enough, and early enough, to be worth a place in the solution.
  bool is_used(const Landmark& landmark, std::size_t min_observations) const;
};

}  // namespace cosight::vins
