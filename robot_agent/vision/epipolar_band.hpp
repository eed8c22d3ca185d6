#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::vision {

/// What is known of how far along its ray a feature lies: 1 / distance from Cs [1/m].
struct InverseDistanceRange {
  double min = 0.0;  ///< 0: infinity
  double max = 0.0;

  /// Anything between two distances [m].
  static InverseDistanceRange between(double near, double far) { return {1.0 / far, 1.0 / near}; }
  /// A landmark's own, `n_sigmas` to either side; never beyond `near` [m] or infinity.
  static InverseDistanceRange around(double mean, double sigma, double n_sigmas, double near);
};

struct EpipolarOptions {
  double n_sigmas = 3.0;         ///< half-width of the band; its true rate is that of one dimension
  double sigma_pixel_S = 1.0;    ///< [px] noise of the pixel in Cs
  double sigma_pixel_F = 1.0;    ///< [px] noise of the match in Cf
  double max_half_width = 60.0;  ///< [px] bound: a pose known worse than this only costs time
};

/// Where the match of one pixel of Cs may lie in Cf: the image of its ray between two distances, lens
/// included, as wide as the covariances of pose and pixels say (first order). At inverse distance rho, with m
/// the ray's unit direction in S, the pixel is that of
///
///   h = R_SF^T Exp(-dtheta) ( m - rho (t + dp) )        [T_SF's error in the axes of S]
class EpipolarBand {
 public:
  static constexpr int kMaxSamples = 17;

  struct Sample {
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();           ///< in F
    double inverse_distance = 0.0;                             ///< from S [1/m]
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [px^2]
  };

  /// Nothing when the pixel has no ray, or no point of the range is seen by Cf even allowing for the band's
  /// width.
  static std::optional<EpipolarBand> predict(const CameraModel& camera_S, const CameraModel& camera_F,
                                             const UncertainPose& T_SF, const Eigen::Vector2d& pixel_S,
                                             const InverseDistanceRange& range,
                                             const EpipolarOptions& options = {});

  /// Mahalanobis distance of a pixel of F to the nearest place of the curve, in sigmas.
  double distance(const Eigen::Vector2d& pixel_F) const;

  /// Within n_sigmas, and within the bound of the width.
  bool inside(const Eigen::Vector2d& pixel_F) const;

  /// Samples in the order of growing inverse distance; the curve is straight between them.
  std::size_t size() const { return size_; }
  const Sample& sample(std::size_t i) const { return samples_[i]; }

  /// Half-width across the curve at a sample: n sigmas along the curve's normal, bounded [px].
  double half_width(std::size_t i) const { return half_widths_[i]; }

  /// Length of the curve [px].
  double length() const;

  const Rectangle& bounds() const { return bounds_; }

 private:
  EpipolarBand() = default;
  void measure(const EpipolarOptions& options);
  void measure_pieces();

  /// From one sample to the next.
  struct Piece {
    Eigen::Vector2d s;   ///< the step [px]
    Eigen::Matrix2d A;   ///< mean information of the two [1/px^2]
    Eigen::Vector2d As;  ///< A s
    double ss = 0.0;     ///< s.A s
  };

  std::array<Sample, kMaxSamples> samples_;
  std::array<double, kMaxSamples> half_widths_{};
  std::array<Eigen::Matrix2d, kMaxSamples> informations_;
  std::array<Piece, kMaxSamples - 1> pieces_;
  std::size_t size_ = 0;
  double n_sigmas_ = 3.0;
  double max_half_width_ = 0.0;
  Rectangle bounds_;  ///< of the curve and its width [px]
};

}  // namespace cosight::vision
