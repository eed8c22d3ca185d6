#pragma once

#include <cstdint>
#include <optional>

#include "robot_agent/wearer/odometry_frame.hpp"
#include "robot_agent/wearer/options.hpp"
#include "robot_agent/wearer/person_tracks.hpp"
#include "robot_agent/wearer/static_map.hpp"
#include "robot_agent/wearer/worn_camera.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::wearer {

/// What came in and what became of it.
struct WearerCounters {
  std::uint64_t scans = 0;
  std::uint64_t scans_refused = 0;           ///< could not be a scan, or of a laser that nobody knows
  std::uint64_t scans_late = 0;              ///< older than one already used
  std::uint64_t scans_without_odometry = 0;  ///< the robot's own motion was a guess
  std::uint64_t ahrs_refused = 0;
  std::uint64_t seen = 0;       ///< scans that showed the wearer
  std::uint64_t predicted = 0;  ///< scans that did not, while the wearer was still known
  std::uint64_t losses = 0;     ///< times that the wearer had to be looked for anew
};

/// Where the wearer is (C sections 2 and 4): laser scans -> what is no furniture -> legs -> people -> the one
/// that is the wearer -> head -> free camera. A pure function of the order of the calls: no clock, no thread.
///
///   for each sample by stamp: tracker.add_odometry / add_ahrs / add_scan
///   after each estimate of the robot's pose: tracker.set_robot_orientation
///
/// Odometry and AHRS may be missing; then the covariance says so.
class WearerTracker {
 public:
  explicit WearerTracker(const WearerOptions& options = {});

  void add_odometry(const WheelOdometrySample& sample) { odometry_.add(sample); }
  void add_ahrs(const AhrsSample& sample);

  /// T_SF at the scan's stamp, position only (`has_orientation` is false); nothing while the wearer is not
  /// known well enough.
  std::optional<WearerPoseSample> add_scan(const LaserScanSample& sample);

  /// Orientation of the SLAM camera in the robot's map W (z up) and the deviation of its yaw [rad]. It joins
  /// map and odometry, so that the AHRS tells where on the head the camera is.
  void set_robot_orientation(Stamp stamp, const Eigen::Quaterniond& q_WS, double yaw_sigma);

  /// From the AHRS's north to W's x axis, see YawOffset.
  void set_yaw_offset(const UncertainAngle& yaw_WA) { worn_camera_.set_yaw_offset(yaw_WA); }

  /// The wearer's body in O; null while nobody is taken for the wearer.
  const PersonTrack* wearer() const { return wearer_ ? people_.find(*wearer_) : nullptr; }
  const PersonTracks& people() const { return people_; }
  const WearerCounters& counters() const { return counters_; }
  const OdometryFrame& odometry() const { return odometry_; }

 private:
  std::vector<BodySighting> bodies_in(const PlanarScan& scan) const;
  void remember_furniture(const PlanarScan& scan);
  void forget_the_lost(Stamp stamp);
  void look_for_wearer(Stamp stamp, const Pose& T_OB);
  bool may_be_wearer(const PersonTrack& track, Stamp stamp, const Pose& T_OB) const;
  std::optional<WearerPoseSample> report(Stamp stamp, const Pose& T_OB);

  /// Where somebody who was the wearer was seen last.
  struct LastPlace {
    Stamp stamp = 0;
    Eigen::Vector2d p_O = Eigen::Vector2d::Zero();
  };

  WearerOptions options_;
  OdometryFrame odometry_;
  StaticMap furniture_;
  PersonTracks people_;
  WornCamera worn_camera_;
  std::optional<std::uint64_t> wearer_;
  std::optional<LastPlace> last_place_;
  std::optional<Stamp> stamp_;
  WearerCounters counters_;
};

}  // namespace cosight::wearer
