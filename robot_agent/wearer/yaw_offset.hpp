#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "robot_agent/wearer/uncertain_angle.hpp"
#include "shared/dataset/stamp.hpp"

namespace cosight::wearer {

struct YawOffsetOptions {
  UncertainAngle prior{0.0, 1.8};  ///< yaw_WA at the start [rad]; 1.8 is as good as nothing
  double drift = 0.006;            ///< of the magnetic surroundings [rad/sqrt(s)]: 2 degrees in half a minute
  double ahrs_sigma = 0.005;       ///< of one AHRS yaw, what changes within seconds [rad]
  double gate = 10.8;              ///< squared innovation over its variance: 99.9 % of one dof
  int gated_until_jump = 8;        ///< so many gated ones in a row: the offset has jumped
};

/// What one piece of evidence did.
struct YawReport {
  enum class Outcome { kFused, kGated, kRefused };

  double innovation = 0.0;  ///< [rad]
  double sigma = 0.0;       ///< of the innovation [rad]
  double nis = 0.0;
  Outcome outcome = Outcome::kRefused;  ///< was no number
};

/// How the AHRS's own world A (x to its north) lies in the robot's map W, both level: R_WA = R_z(yaw_WA). A
/// scalar Kalman filter on the circle whose state walks randomly, as iron and magnets come and go.
class YawOffset {
 public:
  explicit YawOffset(const YawOffsetOptions& options = {});

  /// An orientation of the worn camera from its image, with the covariance of its error in the axes of W
  /// [rad^2], and the AHRS's at the same time:
  ///
  ///   z = twist about z of q_WF q_AF^-1
  YawReport sighting(Stamp stamp, const Eigen::Quaterniond& q_WF, const Eigen::Matrix3d& covariance,
                     const Eigen::Quaterniond& q_AF);

  /// yaw_WA in (-pi, pi] at the last evidence.
  UncertainAngle yaw_WA() const;
  /// The same at a later time.
  UncertainAngle yaw_WA(Stamp stamp) const;

 private:
  double variance_at(Stamp stamp) const;
  void advance(Stamp stamp);
  YawReport innovation(double z, double R) const;
  void fuse(YawReport& report, double R);
  void gated(const YawReport& report);

  YawOffsetOptions options_;
  double angle_ = 0.0;
  double variance_ = 0.0;
  std::optional<Stamp> stamp_;
  int gated_in_a_row_ = 0;
};

}  // namespace cosight::wearer
