#pragma once

#include <Eigen/Core>
#include <optional>

namespace cosight::ekf {

/// Azimuth and elevation of a ray in the z-up world [rad].
struct RayAngles {
  double theta = 0.0;
  double phi = 0.0;
};

/// Unit ray m = [cos(phi) cos(theta), cos(phi) sin(theta), sin(phi)]; singular only straight up and down.
/// `J` (may be null): d m / d (theta, phi), 3x2.
Eigen::Vector3d ray_of_angles(const RayAngles& angles, Eigen::Matrix<double, 3, 2>* J = nullptr);

/// The inverse of ray_of_angles for a direction of any length. Nothing when it points straight up or down
/// (within 1e-6 rad), where theta has no value. `J` (may be null): d (theta, phi) / d ray, 2x3.
std::optional<RayAngles> angles_of_ray(const Eigen::Vector3d& ray_W,
                                       Eigen::Matrix<double, 2, 3>* J = nullptr);

/// A landmark by its inverse depth: p_W = anchor + m(theta, phi) / rho.
struct InverseDepthPoint {
  static constexpr int kAnchor = 0;
  static constexpr int kTheta = 3;
  static constexpr int kPhi = 4;
  static constexpr int kRho = 5;
  static constexpr int kDim = 6;
  using Vector = Eigen::Matrix<double, kDim, 1>;

  Eigen::Vector3d anchor_W = Eigen::Vector3d::Zero();  ///< camera centre when it entered the map [m]
  double theta = 0.0;                                  ///< azimuth in W [rad]
  double phi = 0.0;                                    ///< elevation in W [rad]
  double rho = 1.0;                                    ///< inverse depth [1/m]; zero and less: at infinity

  static InverseDepthPoint from_vector(const Vector& y) {
    return {y.segment<3>(kAnchor), y(kTheta), y(kPhi), y(kRho)};
  }
  Vector vector() const {
    Vector y;
    y << anchor_W, theta, phi, rho;
    return y;
  }

  /// m(theta, phi), unit length.
  Eigen::Vector3d ray_W(Eigen::Matrix<double, 3, 2>* J = nullptr) const {
    return ray_of_angles({theta, phi}, J);
  }

  /// Point in W [m]; not finite when rho is zero. `J` (may be null): d p_W / d y.
  Eigen::Vector3d p_W(Eigen::Matrix<double, 3, kDim>* J = nullptr) const;
};

/// How far from linear the landmark's depth is as seen from r_WS: Civera's index
///
///   L = 4 sigma_d / d_1 |cos alpha|,    sigma_d = sigma_rho / rho^2,
///
/// d_1 the distance from r_WS, alpha the parallax between anchor and r_WS. Below 0.1 a point with a Gaussian
/// error says as much as the inverse depth does. Infinite where the point is at infinity.
double depth_nonlinearity(const InverseDepthPoint& y, double sigma_rho, const Eigen::Vector3d& r_WS);

}  // namespace cosight::ekf
