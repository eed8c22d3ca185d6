#include "sim/known_points.hpp"

#include <opencv2/imgproc.hpp>

namespace cosight::sim {
namespace {

/// The quad that a patch of 13 x 13 pixels lies on; nothing when it is more than one.
std::optional<Hit> hit_of_patch(const Eigen::Vector2d& pixel, const Camera& camera, const Pose& T_WC,
                                std::span<const Quad> quads) {
  const auto hit_through = [&](const Eigen::Vector2d& at) {
    return cast_ray(quads, T_WC.p, T_WC.q * camera.ray_through(at).homogeneous());
  };
  const std::optional<Hit> hit = hit_through(pixel);
  for (const double dx : {-6.0, 6.0}) {
    for (const double dy : {-6.0, 6.0}) {
      const std::optional<Hit> corner = hit_through(pixel + Eigen::Vector2d(dx, dy));
      if (!hit || !corner || corner->quad != hit->quad) return std::nullopt;
    }
  }
  return hit;
}

std::vector<cv::Point2f> corners_of(const GrayImage& picture, int count) {
  const cv::Mat image(picture.height, picture.width, CV_8U, const_cast<std::uint8_t*>(picture.data.data()));
  const double spread = 0.12 * picture.width;
  std::vector<cv::Point2f> corners;
  cv::goodFeaturesToTrack(image, corners, 3 * count, 0.01, spread, cv::noArray(), 7);
  if (corners.empty()) return corners;
  cv::cornerSubPix(image, corners, {4, 4}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 30, 0.005});
  return corners;
}

}  // namespace

std::vector<KnownPoint> survey(const GrayImage& picture, const Camera& camera, const Pose& T_WC,
                               std::span<const Quad> quads, std::size_t building_quads, int count) {
  std::vector<KnownPoint> points;
  if (count <= 0) return points;
  for (const cv::Point2f& corner : corners_of(picture, count)) {
    const Eigen::Vector2d pixel(corner.x, corner.y);
    if (!camera.calibration().contains(pixel, 10.0)) continue;
    const std::optional<Hit> hit = hit_of_patch(pixel, camera, T_WC, quads);
    if (!hit || hit->quad >= building_quads || quads[hit->quad].reflectivity > 0.0F) continue;
    const Eigen::Vector3d direction = T_WC.q * camera.ray_through(pixel).homogeneous();
    points.push_back({T_WC.p + hit->range * direction, pixel});
    if (points.size() == static_cast<std::size_t>(count)) break;
  }
  return points;
}

}  // namespace cosight::sim
