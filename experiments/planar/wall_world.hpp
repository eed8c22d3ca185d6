#pragma once

#include <Eigen/Core>
#include <optional>
#include <random>
#include <vector>

namespace cosight::experiments {

/// The simulated world of C section 5.1: a camera passes a wall of landmarks. Angles here in degrees, as the
/// paper gives them; everything else in m, s, rad.
struct WallWorldOptions {
  double duration = 30.0;                 ///< [s]
  double dt = 0.1;                        ///< [s]
  double path = 14.0;                     ///< [m] along the wall
  double wall_distance = 4.0;             ///< [m] mean
  double wall_relief = 1.0;               ///< [m] a landmark stands so far before or behind the wall, at most
  double landmark_spacing = 0.3;          ///< [m]
  double field_of_view_deg = 70.0;        ///< whole
  double bearing_sigma_deg = 1.0;         ///< of Cs
  double stereo_bearing_sigma_deg = 6.0;  ///< of a pseudo-stereo measurement
  double range_sigma = 0.5;               ///< [m] of a pseudo-stereo measurement
};

/// Position and heading in the plane; heading counted from x towards z.
struct PlanarPose {
  Eigen::Vector2d p = Eigen::Vector2d::Zero();  ///< x along the wall, z towards it [m]
  double theta = 0.0;                           ///< [rad]
};

/// What one camera pair says of one landmark in one frame.
struct WallSighting {
  int landmark = 0;
  double bearing = 0.0;  ///< from Cs's axis [rad]
  double stereo_bearing = 0.0;
  double range = 0.0;  ///< [m]
};

/// Exact truth and noisy sightings. Each noise has its own stream of draws: two runs of one seed that differ
/// only in what they use of it see the same world.
class WallWorld {
 public:
  WallWorld(unsigned seed, const WallWorldOptions& options);

  int steps() const;
  /// Truth moves on by one step.
  void step();

  double time() const { return options_.dt * frame_; }
  const PlanarPose& camera() const { return camera_; }
  const std::vector<Eigen::Vector2d>& landmarks() const { return landmarks_; }

  /// Landmarks in the field of view now, with fresh noise.
  std::vector<WallSighting> observe();

 private:
  PlanarPose pose_at(double t) const;

  WallWorldOptions options_;
  std::vector<Eigen::Vector2d> landmarks_;
  PlanarPose camera_;
  int frame_ = 0;
  std::mt19937_64 bearing_rng_;
  std::mt19937_64 stereo_rng_;
  std::normal_distribution<double> bearing_noise_;
  std::normal_distribution<double> stereo_noise_;
  double sway_phase_ = 0.0;
  double turn_phase_ = 0.0;
};

}  // namespace cosight::experiments
