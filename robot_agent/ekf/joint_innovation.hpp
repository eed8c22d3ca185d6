#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "robot_agent/ekf/camera_state.hpp"
#include "robot_agent/ekf/gaussian_state.hpp"
#include "robot_agent/ekf/inverse_depth_point.hpp"
#include "robot_agent/ekf/rig_error.hpp"

namespace cosight::ekf {

/// One linearised measurement: its rows of H touch the camera's pose, one landmark's block and, of the free
/// camera's pixels where that is a state, the error of T_SF.
struct LinearisedMeasurement {
  int measurement = 0;  ///< index in the caller's list
  int row = 0;          ///< first row in g and S
  int rows = 2;         ///< 2 a pixel of either camera, 3 point
  int offset = 0;       ///< of the landmark's block in x
  int dim = 6;          ///< of the landmark's block: 6 inverse depth, 3 Euclidean
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();  ///< z - h(x), first `rows` entries
  Eigen::Matrix<double, 3, CameraState::kPoseDim> H_camera;
  Eigen::Matrix<double, 3, InverseDepthPoint::kDim> H_landmark;  ///< first `dim` columns
  bool sees_rig_error = false;
  Eigen::Matrix<double, 2, RigError::kDim> H_rig = Eigen::Matrix<double, 2, RigError::kDim>::Zero();
  Eigen::Matrix3d R = Eigen::Matrix3d::Zero();
  bool shares_error = false;  ///< of T_SF, by shared_factor
  Eigen::Matrix<double, 3, 6> shared_factor = Eigen::Matrix<double, 3, 6>::Zero();
  double nis = 0.0;  ///< g_i^T S_ii^-1 g_i; not finite when S_ii cannot be inverted
};

/// The stacked innovation of one frame (B1-B3): g, P H^T, S = H P H^T + R. Storage is kept between frames.
class JointInnovation {
 public:
  JointInnovation(int state_capacity, int row_capacity);

  void clear();
  void push_back(const LinearisedMeasurement& measurement);

  /// Fills P H^T, S (lower triangle) and each measurement's NIS. With `correlated`, what the measurements
  /// share (LinearisedMeasurement::shared_factor) enters S off the diagonal as well.
  void compute(const GaussianState& state, bool correlated);

  /// Drops every measurement whose entry in `keep` is zero, with its rows and columns. One entry a
  /// measurement.
  void keep_only(std::span<const char> keep);

  int rows() const { return rows_; }
  std::span<LinearisedMeasurement> measurements() { return measurements_; }
  std::span<const LinearisedMeasurement> measurements() const { return measurements_; }
  auto g() const { return g_.head(rows_); }
  auto S_lower() const { return S_.topLeftCorner(rows_, rows_); }
  auto P_Ht() const { return P_Ht_.topLeftCorner(state_size_, rows_); }

 private:
  void add_row_products(const GaussianState& state, const LinearisedMeasurement& measurement);
  void add_innovation_covariance(const LinearisedMeasurement& measurement);
  void add_shared_errors();

  std::vector<LinearisedMeasurement> measurements_;
  int rows_ = 0;
  int state_size_ = 0;
  Eigen::VectorXd g_;
  Eigen::MatrixXd P_Ht_;  ///< rows in whole panels of eight
  Eigen::MatrixXd S_;
};

}  // namespace cosight::ekf
