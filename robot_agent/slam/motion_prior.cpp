#include "robot_agent/slam/motion_prior.hpp"

#include <vector>

#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/vision/known_points.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::slam {

std::optional<Pose> MotionPrior::find(const vision::PointTracker& tracker, const ekf::Filter& filter,
                                      const LandmarkTracks& tracks) const {
  std::vector<vision::TrackStart> starts;
  std::vector<Eigen::Vector3d> candidates_W;
  for (const LandmarkTrack& track : tracks.all()) {
    const auto landmark = track.found ? filter.landmark(track.id) : std::nullopt;
    if (!landmark) continue;
    const Eigen::Vector3d p_W = finite_point(*landmark);
    // From where the motion so far leads: from the old place, a repeated pattern is found one period off.
    const auto predicted = filter.camera_model().project(filter.camera().T_WS().inverse() * p_W);
    const bool in_view = predicted && filter.camera_model().contains(*predicted);
    starts.push_back({track.pixel, in_view ? *predicted : track.pixel, nullptr});
    candidates_W.push_back(p_W);
  }
  const std::vector<vision::Track> found = tracker.track(starts);
  std::vector<vision::KnownPoint> points;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i]) points.push_back({candidates_W[i], found[i].pixel});
  }
  vision::KnownPointsOptions options;
  options.seed = seed_;
  options.min_inliers = 6;
  const auto pose = vision::estimate_pose_ransac(filter.camera_model(), points, options);
  if (!pose || 2 * pose->inlier_count < static_cast<int>(points.size())) return std::nullopt;
  return pose->T_WC.T;
}

std::optional<UncertainPose> pose_of_sightings(const ekf::Filter& filter,
                                               const std::vector<Sighting>& sightings,
                                               const Eigen::Matrix<double, 6, 6>& drift, std::uint32_t seed) {
  std::vector<vision::KnownPoint> points;
  for (const Sighting& sighting : sightings) {
    if (const auto landmark = filter.landmark(sighting.landmark)) {
      points.push_back({finite_point(*landmark), sighting.pixel});
    }
  }
  vision::KnownPointsOptions options;
  options.sigma_pixel = filter.options().pixel_sigma;
  options.seed = seed;
  options.min_inliers = 6;
  const auto pose = vision::estimate_pose_ransac(filter.camera_model(), points, options);
  if (!pose || 2 * pose->inlier_count < static_cast<int>(points.size())) return std::nullopt;
  UncertainPose T_WS = pose->T_WC;
  T_WS.covariance += drift;
  return T_WS;
}

ekf::CameraState moved(const ekf::CameraState& before, const Pose& T_WS, double dt) {
  ekf::CameraState now;
  now.r_WS = T_WS.p;
  now.q_WS = T_WS.q;
  if (now.q_WS.dot(before.q_WS) < 0.0) now.q_WS.coeffs() *= -1.0;  // the covariance is that of this sign
  now.v_W = (T_WS.p - before.r_WS) / dt;
  now.omega_S = quaternion_log(before.q_WS.conjugate() * T_WS.q) / dt;
  return now;
}

}  // namespace cosight::slam
