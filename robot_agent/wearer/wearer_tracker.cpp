#include "robot_agent/wearer/wearer_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "robot_agent/wearer/body_sighting.hpp"
#include "robot_agent/wearer/planar_scan.hpp"

namespace cosight::wearer {
namespace {

double yaw_of(const Eigen::Quaterniond& q) {
  const Eigen::Vector3d forward = q * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

WearerTracker::WearerTracker(const WearerOptions& options)
    : options_(options), furniture_(options.scene), people_(options.track), worn_camera_(options.head) {}

void WearerTracker::add_ahrs(const AhrsSample& sample) {
  if (!worn_camera_.add_ahrs(sample)) ++counters_.ahrs_refused;
}

std::optional<WearerPoseSample> WearerTracker::add_scan(const LaserScanSample& sample) {
  ++counters_.scans;
  const auto mount = options_.lasers.find(sample.laser);
  if (mount == options_.lasers.end()) {
    ++counters_.scans_refused;
    return std::nullopt;
  }
  if (stamp_ && sample.stamp < *stamp_) {
    ++counters_.scans_late;
    return std::nullopt;
  }
  const Pose T_OB = odometry_.T_OB(sample.stamp);
  const auto scan = seen_from_above(sample, mount->second, T_OB, options_.scene);
  if (!scan) {
    ++counters_.scans_refused;
    return std::nullopt;
  }
  stamp_ = sample.stamp;
  const bool motion_known = odometry_.knows(sample.stamp);
  if (!motion_known) ++counters_.scans_without_odometry;
  people_.predict(sample.stamp, motion_known ? options_.track.acceleration : options_.track.unknown_motion);
  people_.update(sample.stamp, bodies_in(*scan), wearer_);
  remember_furniture(*scan);
  forget_the_lost(sample.stamp);
  if (!wearer_) look_for_wearer(sample.stamp, T_OB);
  return report(sample.stamp, T_OB);
}

std::vector<BodySighting> WearerTracker::bodies_in(const PlanarScan& scan) const {
  std::vector<ScanPoint> points = scan.points;
  std::erase_if(points, [&](const ScanPoint& point) {
    return (point.p_O - scan.origin_O()).norm() > options_.scene.max_person_range;
  });
  std::vector<ScanPoint> furniture = take_walls(points, options_.scene.wall_length, scan.sigma);
  std::erase_if(points, [&](const ScanPoint& point) {
    const bool still = furniture_.is_static(point.p_O);
    if (still) furniture.push_back(point);
    return still;
  });
  const std::vector<Limb> limbs = find_limbs(scan, points, furniture, options_.scene, options_.person);
  return possible_bodies(scan, limbs, options_.person);
}

void WearerTracker::remember_furniture(const PlanarScan& scan) {
  constexpr double kInSight = 0.3;  // [s]
  std::vector<Eigen::Vector2d> people;
  for (const PersonTrack& track : people_.all()) {
    const bool in_sight = to_seconds(scan.stamp - track.seen) < kInSight;
    if (in_sight && (track.id == wearer_ || track.has_moved())) people.push_back(track.p_O());
  }
  furniture_.observe(scan, people);
}

void WearerTracker::forget_the_lost(Stamp stamp) {
  const PersonTrack* track = wearer();
  if (track == nullptr) return;
  // What never moved and is seen no more was no person: then the search begins as at the start.
  if (last_place_ || track->has_moved()) last_place_ = LastPlace{stamp, track->p_O()};
  const bool furniture = !last_place_ && to_seconds(stamp - track->seen) > options_.track.drop_after;
  if (!furniture && track->worst_sigma() < options_.track.forget_sigma) return;
  wearer_.reset();
  ++counters_.losses;
}

bool WearerTracker::may_be_wearer(const PersonTrack& track, Stamp stamp, const Pose& T_OB) const {
  const StartOptions& start = options_.start;
  constexpr int kFewest = 4;
  if (track.seen != stamp || track.sightings < kFewest || to_seconds(stamp - track.born) < start.seen_for)
    return false;
  if (last_place_) {
    const double reach = start.radius + start.search_speed * to_seconds(stamp - last_place_->stamp);
    return track.has_moved() && (track.p_O() - last_place_->p_O).norm() < reach;
  }
  const Eigen::Vector2d p_B = (T_OB.inverse() * Eigen::Vector3d(track.x[0], track.x[1], 0.0)).head<2>();
  if (start.p_B) return (p_B - *start.p_B).norm() < start.radius;
  return p_B.norm() < start.max_range && std::abs(std::atan2(p_B.y(), p_B.x())) < start.max_bearing;
}

void WearerTracker::look_for_wearer(Stamp stamp, const Pose& T_OB) {
  const Eigen::Vector3d guess_B = options_.start.p_B
                                      ? Eigen::Vector3d(options_.start.p_B->x(), options_.start.p_B->y(), 0.0)
                                      : Eigen::Vector3d::Zero();
  const Eigen::Vector2d guess_O = last_place_ ? last_place_->p_O : (T_OB * guess_B).head<2>();
  double nearest = 0.0;
  for (const PersonTrack& track : people_.all()) {
    const double distance = (track.p_O() - guess_O).norm();
    if (!may_be_wearer(track, stamp, T_OB) || (wearer_ && distance >= nearest)) continue;
    nearest = distance;
    wearer_ = track.id;
  }
}

std::optional<WearerPoseSample> WearerTracker::report(Stamp stamp, const Pose& T_OB) {
  const PersonTrack* track = wearer();
  if (track == nullptr) return std::nullopt;
  ++(track->seen == stamp ? counters_.seen : counters_.predicted);
  if (track->worst_sigma() > options_.track.lost_sigma) return std::nullopt;
  return worn_camera_.pose(stamp, track->p_O(), track->position_covariance(), T_OB);
}

void WearerTracker::set_robot_orientation(Stamp stamp, const Eigen::Quaterniond& q_WS, double yaw_sigma) {
  if (!q_WS.coeffs().allFinite() || !std::isfinite(yaw_sigma)) return;
  const double yaw_WB = yaw_of(q_WS * options_.head.T_BS.q.conjugate());
  const double yaw_OB = yaw_of(odometry_.T_OB(stamp).q);
  worn_camera_.set_map_yaw(stamp, {yaw_OB - yaw_WB, yaw_sigma});
}

}  // namespace cosight::wearer
