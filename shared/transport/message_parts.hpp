#pragma once

#include <geometry_msgs.h>
#include <std_msgs.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <string_view>

#include "shared/transport/codec.hpp"

namespace cosight::transport {

// What several messages are made of, between the generated types and Eigen. No frame changes here: values go
// over as they are, only orders differ (quaternions x, y, z, w on the wire; matrices row by row).

inline constexpr std::size_t kLongestText = 256;

/// sensor_msgs/Imu and PoseWithCovariance: -1 on the diagonal says that nobody knows this value.
inline constexpr double kUnknown = -1.0;

Fault to_header(Stamp stamp, std::string_view frame_id, std_msgs::msg::Header& header);
Fault from_header(const std_msgs::msg::Header& header, Stamp& stamp);

geometry_msgs::msg::Quaternion to_message(const Eigen::Quaterniond& q);
Eigen::Quaterniond from_message(const geometry_msgs::msg::Quaternion& q);

geometry_msgs::msg::Vector3 to_message(const Eigen::Vector3d& v);
Eigen::Vector3d from_message(const geometry_msgs::msg::Vector3& v);

geometry_msgs::msg::PoseWithCovariance to_message(const UncertainPose& pose);
UncertainPose from_message(const geometry_msgs::msg::PoseWithCovariance& pose);

template <int N>
std::array<double, std::size_t{N} * N> to_rows(const Eigen::Matrix<double, N, N>& m) {
  std::array<double, std::size_t{N} * N> rows{};
  Eigen::Map<Eigen::Matrix<double, N, N, Eigen::RowMajor>>(rows.data()) = m;
  return rows;
}

template <int N>
Eigen::Matrix<double, N, N> from_rows(const std::array<double, std::size_t{N} * N>& rows) {
  return Eigen::Map<const Eigen::Matrix<double, N, N, Eigen::RowMajor>>(rows.data());
}

Fault check_finite(const Eigen::Vector3d& v);

/// Finite, and of length one within 1e-3.
Fault check_rotation(const Eigen::Quaterniond& q);

/// Finite, symmetric, and no eigenvalue below zero but for rounding.
template <int N>
Fault check_covariance(const Eigen::Matrix<double, N, N>& P) {
  if (!P.allFinite()) return Fault::kNotFinite;
  const double tolerance = 1e-9 * (1.0 + P.cwiseAbs().maxCoeff());
  if (!P.isApprox(P.transpose(), 1e-6) && (P - P.transpose()).cwiseAbs().maxCoeff() > tolerance) {
    return Fault::kCovariance;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>> solver(P, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() < -tolerance ? Fault::kCovariance : Fault::kNone;
}

/// Short, and printable ASCII only: it ends up in logs and files.
Fault check_text(std::string_view text);

/// The first that is not kNone. For checks that cost nothing to do in vain.
template <class... Faults>
Fault first_of(Faults... faults) {
  Fault result = Fault::kNone;
  ((result = result == Fault::kNone ? faults : result), ...);
  return result;
}

}  // namespace cosight::transport
