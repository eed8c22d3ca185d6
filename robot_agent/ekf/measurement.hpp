#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "robot_agent/ekf/triangulation.hpp"

namespace cosight::ekf {

/// Stays the same from a landmark's start to its removal, and is never used again.
using LandmarkId = std::uint64_t;

enum class MeasurementKind { kPixel, kPoint, kWearerPixel };

/// A landmark seen in one frame: as a pixel of the SLAM camera (2 rows, C6) and, when the free camera saw it
/// as well, as a pixel of that (2 rows); or, the paper's way, both pixels together as a point (3 rows, C5).
struct Measurement {
  LandmarkId landmark = 0;
  MeasurementKind kind = MeasurementKind::kPixel;
  Eigen::Vector3d z = Eigen::Vector3d::Zero();      ///< pixel (u, v, -) [px], or z_e in S [m]
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< its covariance, upper left 2x2 for a pixel
  /// Covariance between the points of one frame: B_i B_j^T (see PointMeasurement). Zero when independent.
  Eigen::Matrix<double, 3, 6> shared_factor = Eigen::Matrix<double, 3, 6>::Zero();

  static Measurement pixel(LandmarkId landmark, const Eigen::Vector2d& z, double sigma);
  static Measurement point(LandmarkId landmark, const PointMeasurement& measured);
  /// Needs the wearer's pose in the update. `sigma` is the pixel's own noise; that of T_SF comes on top, at
  /// the predicted point.
  static Measurement wearer_pixel(LandmarkId landmark, const Eigen::Vector2d& z, double sigma);

  int rows() const { return kind == MeasurementKind::kPoint ? 3 : 2; }
};

enum class Outcome {
  kFused,
  kUnpredictable,   ///< no such landmark or wearer, behind the camera, outside the lens, at infinity (points)
  kGated,           ///< outside its own gate
  kIncompatible,    ///< taken out by the joint compatibility test
  kIllConditioned,  ///< the joint innovation covariance could not be inverted: nothing was fused
};
const char* to_string(Outcome outcome);

/// What one measurement did to the filter; same shape for pixels and points.
struct MeasurementReport {
  LandmarkId landmark = 0;
  MeasurementKind kind = MeasurementKind::kPixel;
  int rows = 2;
  Eigen::Vector3d innovation = Eigen::Vector3d::Zero();      ///< z - h(x), first `rows` entries
  Eigen::Vector3d innovation_std = Eigen::Vector3d::Zero();  ///< sqrt(diag S)
  double nis = 0.0;                                          ///< g^T S^-1 g of this measurement alone
  double gate = 0.0;                                         ///< chi-squared limit it was held against
  Outcome outcome = Outcome::kUnpredictable;
};

/// What one update did.
struct UpdateReport {
  std::vector<MeasurementReport> measurements;  ///< in the order they were given
  int fused = 0;
  int rows = 0;      ///< fused rows, the degrees of freedom of `nis`
  double nis = 0.0;  ///< g^T S^-1 g of all fused together
  int iterations = 0;
};

/// What a measured twist did.
struct TwistReport {
  double nis = 0.0;   ///< six degrees of freedom
  double gate = 0.0;  ///< chi-squared limit it was held against
  Outcome outcome = Outcome::kIllConditioned;
};

}  // namespace cosight::ekf
