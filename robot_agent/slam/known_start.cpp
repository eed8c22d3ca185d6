#include "robot_agent/slam/known_start.hpp"

#include "robot_agent/vision/known_points.hpp"

namespace cosight::slam {
namespace {

std::vector<vision::KnownPoint> points_in_view(const std::vector<KnownPoint>& points,
                                               const CameraModel& camera, const Pose& T_WS) {
  std::vector<vision::KnownPoint> in_view;
  for (const KnownPoint& point : points) {
    const auto pixel = point.pixel ? point.pixel : camera.project(T_WS.inverse() * point.p_W);
    if (pixel && camera.contains(*pixel)) in_view.push_back({point.p_W, *pixel});
  }
  return in_view;
}

}  // namespace

bool start_from_known_points(const std::vector<KnownPoint>& points, const GrayImage& image,
                             const SlamOptions& options, ekf::Filter& filter, LandmarkTracks& tracks) {
  constexpr std::size_t kMinPoints = 4;
  const auto in_view = points_in_view(points, filter.camera_model(), options.start.T_WS);
  if (in_view.size() < kMinPoints) return false;
  vision::KnownPointsOptions pose_options;
  pose_options.sigma_pixel = options.start.known_pixel_sigma;
  const auto pose = vision::estimate_pose(filter.camera_model(), in_view, pose_options);
  if (!pose) return false;
  filter.reset(pose->T_WC, options.motion.start_sigma_velocity, options.motion.start_sigma_angular_velocity);
  const double variance = options.start.known_point_sigma * options.start.known_point_sigma;
  for (const vision::KnownPoint& point : in_view) {
    const auto id = filter.add_known_point(point.p_W, variance * Eigen::Matrix3d::Identity());
    if (id) tracks.add(track_from(image, *id, point.pixel, pose->T_WC.T));
  }
  return true;
}

bool start_at_assumed_depth(double depth, const GrayImage& image, const vision::CornerDetector& detector,
                            const SlamOptions& options, ekf::Filter& filter, LandmarkTracks& tracks) {
  const auto corners = detector.detect(image, {}, options.start.first_landmarks);
  if (static_cast<int>(corners.size()) < options.start.min_landmarks) return false;
  constexpr double kRelativeSigma = 0.5;
  for (const vision::Corner& corner : corners) {
    const auto id = filter.add_landmark_at_depth(corner.pixel, depth, kRelativeSigma);
    if (id) tracks.add(track_from(image, *id, corner.pixel, filter.camera().T_WS()));
  }
  return true;
}

}  // namespace cosight::slam
