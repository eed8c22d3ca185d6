#include <algorithm>
#include <array>
#include <cmath>

#include "robot_agent/ekf/filter.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

using Point = InverseDepthPoint;
using Dependence = GaussianState::Dependence;
using Noise = Eigen::Matrix<double, Point::kDim, Point::kDim>;

/// A new landmark y = Y(x_v, rest) at the present camera, before its inverse depth is known.
struct Anchored {
  Point y;
  Eigen::Matrix<double, Point::kDim, 7> y_camera;  ///< d y / d (r, q) of the present camera; rho's row zero
  Eigen::Matrix<double, 2, 3> angles_ray_S;        ///< d (theta, phi) / d ray in S
};

std::optional<Anchored> anchor(const CameraState& x, const Eigen::Vector3d& ray_S) {
  const Eigen::Matrix3d R_WS = x.q_WS.toRotationMatrix();
  Eigen::Matrix<double, 2, 3> angles_ray_W;
  const auto angles = angles_of_ray(R_WS * ray_S, &angles_ray_W);
  if (!angles) return std::nullopt;
  Anchored a;
  a.y.anchor_W = x.r_WS;
  a.y.theta = angles->theta;
  a.y.phi = angles->phi;
  a.y_camera.setZero();
  a.y_camera.topLeftCorner<3, 3>().setIdentity();
  a.y_camera.block<2, 4>(Point::kTheta, CameraState::kOrientation) =
      angles_ray_W * rotated_point_jacobian(x.q_WS, ray_S);
  a.angles_ray_S = angles_ray_W * R_WS;
  return a;
}

/// A pseudo-stereo landmark with its two kinds of noise as factors: y y^T gets A A^T + B B^T.
struct StereoStart {
  Anchored at;
  Eigen::Matrix<double, Point::kDim, 4> from_pixels;
  Eigen::Matrix<double, Point::kDim, 6> from_pose;  ///< shared by all of the frame
};

std::optional<StereoStart> start_from_stereo(const CameraState& x, const StereoMatch& match,
                                             const StereoRig& rig) {
  const auto point = triangulate(match, rig.camera_S, rig.camera_F, rig.T_SF.T);
  if (!point) return std::nullopt;
  const auto anchored = anchor(x, point->ray_S);
  if (!anchored) return std::nullopt;
  StereoStart start{*anchored, {}, {}};
  start.at.y.rho = point->rho;
  const Eigen::Vector4d sigma(rig.sigma_pixel_S, rig.sigma_pixel_S, rig.sigma_pixel_F, rig.sigma_pixel_F);
  Eigen::Matrix<double, Point::kDim, 4> y_pixels = Eigen::Matrix<double, Point::kDim, 4>::Zero();
  y_pixels.block<2, 2>(Point::kTheta, 0) = anchored->angles_ray_S * point->ray_pixel_S;
  y_pixels.row(Point::kRho) = point->rho_pixels;
  start.from_pixels = y_pixels * sigma.asDiagonal();
  start.from_pose.setZero();
  start.from_pose.row(Point::kRho) =
      point->rho_pose * position_quaternion_jacobian(rig.T_SF.T) * covariance_factor(rig.T_SF.covariance);
  return start;
}

/// A landmark seen first from T_WS_first and now from x, with Jacobians by all it comes from.
struct DelayedStart {
  Anchored at;
  Eigen::Matrix<double, Point::kDim, 4> y_pixels;  ///< d y / d (u_first v_first u_now v_now)
  Eigen::Matrix<double, Point::kDim, 7> y_first;   ///< d y / d (r, q) of the first pose
};

std::optional<DelayedStart> start_delayed(const CameraModel& camera, const CameraState& x,
                                          const Pose& T_WS_first, const Eigen::Vector2d& first_pixel,
                                          const Eigen::Vector2d& pixel_now) {
  Eigen::Matrix<double, 3, 2> h_1_pixel;
  Eigen::Matrix<double, 3, 2> h_2_pixel;
  const auto h_1 = camera.unproject(first_pixel, &h_1_pixel);
  const auto h_2 = camera.unproject(pixel_now, &h_2_pixel);
  if (!h_1 || !h_2) return std::nullopt;
  const Eigen::Matrix3d R_1 = T_WS_first.q.toRotationMatrix();
  const Eigen::Matrix3d R_2 = x.q_WS.toRotationMatrix();
  const auto depth = inverse_depth_by_sines(R_2 * *h_2, R_1 * *h_1, x.r_WS - T_WS_first.p);
  if (!depth || !(depth->parallax > 0.0) || !(depth->rho > 0.0)) return std::nullopt;
  const auto anchored = anchor(x, *h_2);
  if (!anchored) return std::nullopt;

  DelayedStart start{*anchored, {}, {}};
  start.at.y.rho = depth->rho;
  start.at.y_camera.row(Point::kRho) << depth->rho_b,
      depth->rho_h_current * rotated_point_jacobian(x.q_WS, *h_2);
  start.y_first.setZero();
  start.y_first.row(Point::kRho) << -depth->rho_b,
      depth->rho_h_other * rotated_point_jacobian(T_WS_first.q, *h_1);
  start.y_pixels.setZero();
  start.y_pixels.block<2, 2>(Point::kTheta, 2) = anchored->angles_ray_S * h_2_pixel;
  start.y_pixels.row(Point::kRho) << depth->rho_h_other * R_1 * h_1_pixel,
      depth->rho_h_current * R_2 * h_2_pixel;
  return start;
}

}  // namespace

LandmarkId Filter::append_landmark(const Eigen::Ref<const Eigen::VectorXd>& y,
                                   std::span<const Dependence> dependences,
                                   const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  const int offset = state_.append(y, dependences, noise);
  landmarks_.push_back({next_id_++, offset, static_cast<int>(y.size())});
  return landmarks_.back().id;
}

std::optional<LandmarkId> Filter::add_pseudo_stereo_landmark(const StereoMatch& match, const StereoRig& rig) {
  return add_pseudo_stereo_landmarks({&match, 1}, rig).front();
}

std::vector<std::optional<LandmarkId>> Filter::add_pseudo_stereo_landmarks(
    std::span<const StereoMatch> matches, const StereoRig& rig) {
  if (options_.rig_error.is_state) return add_with_rig_error(matches, rig);
  std::vector<std::optional<LandmarkId>> ids;
  std::vector<std::pair<int, StereoStart>> started;  // offset of the block
  const CameraState x = camera();
  for (const StereoMatch& match : matches) {
    ids.emplace_back();
    const auto start = has_room() ? start_from_stereo(x, match, rig) : std::nullopt;
    if (!start) continue;
    const Dependence on_camera{0, start->at.y_camera};
    const Noise noise =
        start->from_pixels * start->from_pixels.transpose() + start->from_pose * start->from_pose.transpose();
    ids.back() = append_landmark(start->at.y.vector(), {&on_camera, 1}, noise);
    const int offset = landmarks_.back().offset;
    if (!options_.correlated_wearer_pose) continue;
    for (const auto& [other_offset, other] : started) {
      state_.P_lower().block<Point::kDim, Point::kDim>(offset, other_offset) +=
          start->from_pose * other.from_pose.transpose();
    }
    started.emplace_back(offset, *start);
  }
  return ids;
}

/// The ray comes from Cs, the depth is left free at the triangulated one, and then the pixels of Cf are
/// measured, all together: a triangulation alone would have no use for their epipolar errors, which tell the
/// error of T_SF.
std::vector<std::optional<LandmarkId>> Filter::add_with_rig_error(std::span<const StereoMatch> matches,
                                                                  const StereoRig& rig) {
  constexpr double kFree = 10.0;  // sigma of the inverse depth in parts of itself: no information
  constexpr int kIterations = 4;  // the matches may turn T_SF by several of its sigmas at once
  const Pose T_SF = corrected_T_SF(rig.T_SF).T;
  const CameraState x = camera();
  std::vector<std::optional<LandmarkId>> ids;
  std::vector<Measurement> measurements;
  for (const StereoMatch& match : matches) {
    ids.emplace_back();
    const auto point = has_room() ? triangulate(match, rig.camera_S, rig.camera_F, T_SF) : std::nullopt;
    auto anchored = point ? anchor(x, point->ray_S) : std::nullopt;
    if (!anchored) continue;
    anchored->y.rho = point->rho;
    Eigen::Matrix<double, Point::kDim, 3> from_noise = Eigen::Matrix<double, Point::kDim, 3>::Zero();
    from_noise.block<2, 2>(Point::kTheta, 0) =
        rig.sigma_pixel_S * anchored->angles_ray_S * point->ray_pixel_S;
    from_noise(Point::kRho, 2) = kFree * point->rho;
    const Dependence on_camera{0, anchored->y_camera};
    const Noise noise = from_noise * from_noise.transpose();
    ids.back() = append_landmark(anchored->y.vector(), {&on_camera, 1}, noise);
    measurements.push_back(Measurement::wearer_pixel(*ids.back(), match.pixel_F, rig.sigma_pixel_F));
  }
  if (measurements.empty()) return ids;
  collect(measurements, &rig);
  if (iterate(measurements, &rig, std::max(kIterations, options_.max_iterations))) finish_update();
  return ids;
}

std::optional<LandmarkId> Filter::add_delayed_landmark(const FirstSighting& first,
                                                       const Eigen::Vector2d& pixel_now) {
  if (!has_room()) return std::nullopt;
  const auto start = start_delayed(camera_model_, camera(), first.T_WS.T, first.pixel, pixel_now);
  if (!start) return std::nullopt;
  const Dependence on_camera{0, start->at.y_camera};
  const double pixel_variance = options_.pixel_sigma * options_.pixel_sigma;
  const Noise noise =
      pixel_variance * start->y_pixels * start->y_pixels.transpose() +
      start->y_first * position_quaternion_covariance(first.T_WS) * start->y_first.transpose();
  return append_landmark(start->at.y.vector(), {&on_camera, 1}, noise);
}

std::optional<LandmarkId> Filter::add_delayed_landmark(CloneId first_pose, const Eigen::Vector2d& first_pixel,
                                                       const Eigen::Vector2d& pixel_now) {
  const Block* clone = find_clone(first_pose);
  if (clone == nullptr || !has_room()) return std::nullopt;
  const Eigen::Matrix<double, 7, 1> pose = state_.x().segment<7>(clone->offset);
  const Pose T_WS_first{from_wxyz(pose.tail<4>()), pose.head<3>()};
  const auto start = start_delayed(camera_model_, camera(), T_WS_first, first_pixel, pixel_now);
  if (!start) return std::nullopt;
  const std::array<Dependence, 2> on_both{Dependence{0, start->at.y_camera},
                                          Dependence{clone->offset, start->y_first}};
  const Noise noise =
      options_.pixel_sigma * options_.pixel_sigma * start->y_pixels * start->y_pixels.transpose();
  return append_landmark(start->at.y.vector(), on_both, noise);
}

std::optional<LandmarkId> Filter::add_landmark_at_depth(const Eigen::Vector2d& pixel, double depth,
                                                        double relative_sigma) {
  Eigen::Matrix<double, 3, 2> ray_pixel;
  const auto ray_S = camera_model_.unproject(pixel, &ray_pixel);
  auto start = ray_S && has_room() ? anchor(camera(), *ray_S) : std::nullopt;
  if (!start) return std::nullopt;
  start->y.rho = 1.0 / depth;
  const Eigen::Matrix2d angles_pixel = start->angles_ray_S * ray_pixel;
  Noise noise = Noise::Zero();
  noise.block<2, 2>(Point::kTheta, Point::kTheta) =
      options_.pixel_sigma * options_.pixel_sigma * angles_pixel * angles_pixel.transpose();
  noise(Point::kRho, Point::kRho) = relative_sigma * relative_sigma / (depth * depth);
  const Dependence on_camera{0, start->y_camera};
  return append_landmark(start->y.vector(), {&on_camera, 1}, noise);
}

std::optional<LandmarkId> Filter::add_known_point(const Eigen::Vector3d& p_W,
                                                  const Eigen::Matrix3d& covariance) {
  if (!has_room() || !p_W.allFinite()) return std::nullopt;
  return append_landmark(p_W, {}, covariance);
}

bool Filter::convert_to_point(LandmarkId id) {
  const Block* found = find(id);
  if (found == nullptr || found->dim != Point::kDim) return false;
  const int offset = found->offset;
  const Point y = Point::from_vector(state_.x().segment<Point::kDim>(offset));
  if (!(y.rho > options_.min_inverse_depth)) return false;
  Eigen::Matrix<double, 3, Point::kDim> J;
  const Eigen::Vector3d p_W = y.p_W(&J);
  state_.transform(offset, p_W, J);
  for (std::vector<Block>* list : {&landmarks_, &clones_}) {
    for (Block& block : *list) {
      if (block.id == id) block.dim = 3;
      if (block.offset > offset) block.offset -= Point::kDim - 3;
    }
  }
  return true;
}

int Filter::convert_linear_landmarks(double max_nonlinearity) {
  const Eigen::Vector3d r_WS = camera().r_WS;
  int converted = 0;
  for (int i = 0; i < landmark_count(); ++i) {
    const Block block = landmarks_[static_cast<std::size_t>(i)];
    if (block.dim != Point::kDim) continue;
    const Point y = Point::from_vector(state_.x().segment<Point::kDim>(block.offset));
    const int rho = block.offset + Point::kRho;
    const double sigma_rho = std::sqrt(state_.covariance<1, 1>(rho, rho).value());
    if (!(depth_nonlinearity(y, sigma_rho, r_WS) < max_nonlinearity)) continue;
    converted += convert_to_point(block.id) ? 1 : 0;
  }
  return converted;
}

}  // namespace cosight::ekf
