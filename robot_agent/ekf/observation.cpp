#include "robot_agent/ekf/observation.hpp"

#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

using Matrix34 = Eigen::Matrix<double, 3, 4>;

constexpr int kR = CameraState::kPosition;
constexpr int kQ = CameraState::kOrientation;

}  // namespace

std::optional<Eigen::Vector2d> BearingObservation::predict(const CameraState& x, const InverseDepthPoint& y,
                                                           Jacobians* jacobians) const {
  Eigen::Matrix<double, 3, 2> m_angles;
  const Eigen::Vector3d m = y.ray_W(&m_angles);
  const Eigen::Vector3d offset_W = y.anchor_W - x.r_WS;
  const Eigen::Vector3d h_W = y.rho * offset_W + m;
  const Eigen::Matrix3d R_SW = x.q_WS.toRotationMatrix().transpose();
  Eigen::Matrix<double, 2, 3> J_pixel;
  auto pixel = camera.project(R_SW * h_W, jacobians != nullptr ? &J_pixel : nullptr);
  if (pixel && jacobians != nullptr) {
    const Eigen::Matrix<double, 2, 3> J_W = J_pixel * R_SW;
    jacobians->H_camera.middleCols<3>(kR) = -y.rho * J_W;
    jacobians->H_camera.middleCols<4>(kQ) = J_pixel * inverse_rotated_point_jacobian(x.q_WS, h_W);
    jacobians->H_landmark.leftCols<3>() = y.rho * J_W;
    jacobians->H_landmark.middleCols<2>(InverseDepthPoint::kTheta) = J_W * m_angles;
    jacobians->H_landmark.col(InverseDepthPoint::kRho) = J_W * offset_W;
  }
  return pixel;
}

std::optional<Eigen::Vector2d> BearingObservation::predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                                           PointJacobians* jacobians) const {
  const Eigen::Vector3d h_W = p_W - x.r_WS;
  const Eigen::Matrix3d R_SW = x.q_WS.toRotationMatrix().transpose();
  Eigen::Matrix<double, 2, 3> J_pixel;
  auto pixel = camera.project(R_SW * h_W, jacobians != nullptr ? &J_pixel : nullptr);
  if (pixel && jacobians != nullptr) {
    jacobians->H_landmark = J_pixel * R_SW;
    jacobians->H_camera.middleCols<3>(kR) = -jacobians->H_landmark;
    jacobians->H_camera.middleCols<4>(kQ) = J_pixel * inverse_rotated_point_jacobian(x.q_WS, h_W);
  }
  return pixel;
}

/// A point of W relative to the camera, and its scale: rho, or 1 in metres.
struct WearerObservation::Scaled {
  Eigen::Vector3d h_W;
  double scale = 1.0;
};

/// Pixel and what both kinds of landmark have in common; `J_S` is d pixel / d h_S.
template <class AnyJacobians>
std::optional<Eigen::Vector2d> WearerObservation::project(const CameraState& x, const Scaled& point,
                                                          AnyJacobians* jacobians,
                                                          Eigen::Matrix<double, kDim, 3>& J_S) const {
  const Eigen::Matrix3d R_SW = x.q_WS.toRotationMatrix().transpose();
  const Eigen::Matrix3d R_FS = T_SF.q.toRotationMatrix().transpose();
  const Eigen::Vector3d from_F_S = R_SW * point.h_W - point.scale * T_SF.p;
  Eigen::Matrix<double, 2, 3> J_pixel;
  auto pixel = camera_F.project(R_FS * from_F_S, jacobians != nullptr ? &J_pixel : nullptr);
  if (!pixel || jacobians == nullptr) return pixel;
  J_S = J_pixel * R_FS;
  jacobians->H_camera.template middleCols<3>(kR) = -point.scale * J_S * R_SW;
  jacobians->H_camera.template middleCols<4>(kQ) = J_S * inverse_rotated_point_jacobian(x.q_WS, point.h_W);
  jacobians->H_wearer << -point.scale * J_S, J_S * skew(from_F_S);
  return pixel;
}

std::optional<Eigen::Vector2d> WearerObservation::predict(const CameraState& x, const InverseDepthPoint& y,
                                                          Jacobians* jacobians) const {
  Eigen::Matrix<double, 3, 2> m_angles;
  const Eigen::Vector3d m = y.ray_W(&m_angles);
  const Eigen::Vector3d offset_W = y.anchor_W - x.r_WS;
  Eigen::Matrix<double, kDim, 3> J_S;
  const auto pixel = project(x, {y.rho * offset_W + m, y.rho}, jacobians, J_S);
  if (pixel && jacobians != nullptr) {
    const Eigen::Matrix3d R_SW = x.q_WS.toRotationMatrix().transpose();
    jacobians->H_landmark.leftCols<3>() = -jacobians->H_camera.middleCols<3>(kR);
    jacobians->H_landmark.middleCols<2>(InverseDepthPoint::kTheta) = J_S * R_SW * m_angles;
    jacobians->H_landmark.col(InverseDepthPoint::kRho) = J_S * (R_SW * offset_W - T_SF.p);
  }
  return pixel;
}

std::optional<Eigen::Vector2d> WearerObservation::predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                                          PointJacobians* jacobians) const {
  Eigen::Matrix<double, kDim, 3> J_S;
  const auto pixel = project(x, {p_W - x.r_WS, 1.0}, jacobians, J_S);
  if (pixel && jacobians != nullptr) jacobians->H_landmark = -jacobians->H_camera.middleCols<3>(kR);
  return pixel;
}

std::optional<Eigen::Vector3d> EuclideanObservation::predict(const CameraState& x, const InverseDepthPoint& y,
                                                             Jacobians* jacobians) const {
  if (!(y.rho > min_inverse_depth)) return std::nullopt;
  Eigen::Matrix<double, 3, InverseDepthPoint::kDim> p_W_y;
  PointJacobians point;
  auto h_e = predict(x, y.p_W(&p_W_y), jacobians != nullptr ? &point : nullptr);
  if (h_e && jacobians != nullptr) {
    jacobians->H_camera = point.H_camera;
    jacobians->H_landmark = point.H_landmark * p_W_y;
  }
  return h_e;
}

std::optional<Eigen::Vector3d> EuclideanObservation::predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                                             PointJacobians* jacobians) const {
  const Eigen::Vector3d offset_W = p_W - x.r_WS;
  const Eigen::Matrix3d R_SW = x.q_WS.toRotationMatrix().transpose();
  const Eigen::Vector3d h_e = R_SW * offset_W;
  if (!(h_e.z() > 0.0)) return std::nullopt;
  if (jacobians != nullptr) {
    jacobians->H_camera.middleCols<3>(kR) = -R_SW;
    jacobians->H_camera.middleCols<4>(kQ) = inverse_rotated_point_jacobian(x.q_WS, offset_W);
    jacobians->H_landmark = R_SW;
  }
  return h_e;
}

Eigen::Vector3d bearing_and_inverse_distance(const Eigen::Vector3d& p_S, Eigen::Matrix3d* J) {
  const double distance = p_S.norm();
  const double x = p_S.x() / p_S.z();
  const double y = p_S.y() / p_S.z();
  if (J != nullptr) {
    J->row(0) << 1.0 / p_S.z(), 0.0, -x / p_S.z();
    J->row(1) << 0.0, 1.0 / p_S.z(), -y / p_S.z();
    J->row(2) = -p_S.transpose() / (distance * distance * distance);
  }
  return {x, y, 1.0 / distance};
}

}  // namespace cosight::ekf
