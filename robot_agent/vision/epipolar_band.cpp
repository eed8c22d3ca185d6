#include "robot_agent/vision/epipolar_band.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/geometry/rotation.hpp"

namespace cosight::vision {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Matrix3 = Eigen::Matrix3d;
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

/// The ray of a pixel of S seen from F, as a function of the inverse distance.
class SightedRay {
 public:
  SightedRay(const CameraModel& camera_F, const UncertainPose& T_SF, const Vector3& direction,
             const Eigen::Matrix<double, 3, 2>& J_direction, const InverseDistanceRange& range,
             const EpipolarOptions& options)
      : camera_F_(camera_F),
        T_SF_(T_SF),
        range_(range),
        m_(direction.normalized()),
        R_FS_(T_SF.T.q.toRotationMatrix().transpose()),
        variance_F_(options.sigma_pixel_F * options.sigma_pixel_F) {
    const Eigen::Matrix<double, 3, 2> J =
        (Matrix3::Identity() - m_ * m_.transpose()) * J_direction / direction.norm();
    covariance_m_ = options.sigma_pixel_S * options.sigma_pixel_S * J * J.transpose();
    towards_ = -m_.dot(T_SF.T.p);
    aside_ = m_.cross(T_SF.T.p).norm();
    first_angle_ = angle(range.min);
    angle_span_ = angle(range.max) - first_angle_;
  }

  /// Inverse distance at a fraction of the range, in equal steps of the angle under which F sees the ray:
  /// equal steps of rho would leave most samples outside the image when the baseline is long.
  double at(double fraction) const {
    constexpr double kNoParallax = 1e-9;  // [m]
    if (aside_ < kNoParallax) return range_.min + fraction * (range_.max - range_.min);
    const double phi = first_angle_ + fraction * angle_span_;
    const double rho = std::sin(phi) / (aside_ * std::cos(phi) - towards_ * std::sin(phi));
    return std::clamp(rho, range_.min, range_.max);
  }

  std::optional<Vector2> pixel(double rho) const { return camera_F_.project(R_FS_ * (m_ - rho * T_SF_.T.p)); }

  std::optional<EpipolarBand::Sample> sample(double rho) const {
    const Vector3 h_S = m_ - rho * T_SF_.T.p;
    Eigen::Matrix<double, 2, 3> J_project;
    const auto pixel = camera_F_.project(R_FS_ * h_S, &J_project);
    if (!pixel) return std::nullopt;
    const Eigen::Matrix<double, 2, 3> J_m = J_project * R_FS_;
    Eigen::Matrix<double, 2, 6> J_pose;
    J_pose.leftCols<3>() = -rho * J_m;
    J_pose.rightCols<3>() = J_m * skew(h_S);
    return EpipolarBand::Sample{*pixel, rho,
                                J_pose * T_SF_.covariance * J_pose.transpose() +
                                    J_m * covariance_m_ * J_m.transpose() +
                                    variance_F_ * Matrix2::Identity()};
  }

 private:
  /// Between m and m - rho t.
  double angle(double rho) const { return std::atan2(rho * aside_, 1.0 + rho * towards_); }

  const CameraModel& camera_F_;
  const UncertainPose& T_SF_;
  InverseDistanceRange range_;
  Vector3 m_;  ///< unit, in S
  Matrix3 R_FS_;
  Matrix3 covariance_m_;
  double variance_F_;
  double towards_ = 0.0;                         ///< -t along m [m]
  double aside_ = 0.0;                           ///< |t| across m [m]
  double first_angle_ = 0.0, angle_span_ = 0.0;  ///< of the range [rad]
};

/// The part of the range whose pixels lie in the image, `margin` allowed around it. Scanned, then its ends
/// bisected; one stretch, since a straight line crosses a convex image once. In fractions of the range.
std::optional<std::pair<double, double>> visible_part(const SightedRay& ray, const CameraModel& camera_F,
                                                      double margin) {
  const auto is_visible = [&](double fraction) {
    const auto pixel = ray.pixel(ray.at(fraction));
    return pixel && camera_F.contains(*pixel, -margin);
  };
  constexpr int kScan = 32;
  const auto at = [](int i) { return static_cast<double>(i) / kScan; };
  int first = 0;
  while (first <= kScan && !is_visible(at(first)))
    ++first;
  if (first > kScan) return std::nullopt;
  int last = first;
  while (last < kScan && is_visible(at(last + 1)))
    ++last;
  const auto bisect = [&](double visible, double hidden) {
    for (int i = 0; i < 12; ++i) {
      const double middle = 0.5 * (visible + hidden);
      (is_visible(middle) ? visible : hidden) = middle;
    }
    return visible;
  };
  return std::pair{first == 0 ? at(0) : bisect(at(first), at(first - 1)),
                   last == kScan ? at(kScan) : bisect(at(last), at(last + 1))};
}

}  // namespace

InverseDistanceRange InverseDistanceRange::around(double mean, double sigma, double n_sigmas, double near) {
  const double limit = 1.0 / near;
  return {std::clamp(mean - n_sigmas * sigma, 0.0, limit), std::clamp(mean + n_sigmas * sigma, 0.0, limit)};
}

std::optional<EpipolarBand> EpipolarBand::predict(const CameraModel& camera_S, const CameraModel& camera_F,
                                                  const UncertainPose& T_SF, const Eigen::Vector2d& pixel_S,
                                                  const InverseDistanceRange& range,
                                                  const EpipolarOptions& options) {
  Eigen::Matrix<double, 3, 2> J_direction;
  const auto direction = camera_S.unproject(pixel_S, &J_direction);
  if (!direction || !(range.max >= range.min)) return std::nullopt;
  const SightedRay ray(camera_F, T_SF, *direction, J_direction, range, options);
  const auto visible = visible_part(ray, camera_F, options.max_half_width);
  if (!visible) return std::nullopt;

  EpipolarBand band;
  // About 40 px between samples: the lens bends the curve by far less than a pixel on that way.
  constexpr double kSpacing = 40.0;
  const auto [first, last] = *visible;
  const auto begin = ray.pixel(ray.at(first));
  const auto end = ray.pixel(ray.at(last));
  const double span = begin && end ? (*end - *begin).norm() : 0.0;
  const int pieces = std::clamp(static_cast<int>(std::ceil(span / kSpacing)), 2, kMaxSamples - 1);
  for (int i = 0; i <= pieces; ++i) {
    const auto sample = ray.sample(ray.at(first + (last - first) * i / pieces));
    if (sample) band.samples_[band.size_++] = *sample;
  }
  if (band.size_ < 2) return std::nullopt;
  band.measure(options);
  const Rectangle& box = band.bounds_;
  if (box.max.x() < 0.0 || box.max.y() < 0.0 || box.min.x() > camera_F.width - 1.0 ||
      box.min.y() > camera_F.height - 1.0) {
    return std::nullopt;
  }
  return band;
}

void EpipolarBand::measure(const EpipolarOptions& options) {
  n_sigmas_ = options.n_sigmas;
  max_half_width_ = options.max_half_width;
  bounds_ = {samples_[0].pixel, samples_[0].pixel};
  for (std::size_t i = 0; i < size_; ++i) {
    const Vector2 along = samples_[std::min(i + 1, size_ - 1)].pixel - samples_[i > 0 ? i - 1 : 0].pixel;
    const Vector2 across =
        along.norm() > 1e-6 ? Vector2(-along.y(), along.x()).normalized() : Vector2::UnitX().eval();
    const double sigma = std::sqrt(across.dot(samples_[i].covariance * across));
    half_widths_[i] = std::min(n_sigmas_ * sigma, max_half_width_);
    informations_[i] = samples_[i].covariance.inverse();
    const Vector2 reach =
        (n_sigmas_ * samples_[i].covariance.diagonal().cwiseSqrt()).cwiseMin(max_half_width_);
    bounds_.min = bounds_.min.cwiseMin(samples_[i].pixel - reach);
    bounds_.max = bounds_.max.cwiseMax(samples_[i].pixel + reach);
  }
  measure_pieces();
}

void EpipolarBand::measure_pieces() {
  for (std::size_t i = 0; i + 1 < size_; ++i) {
    Piece& piece = pieces_[i];
    piece.s = samples_[i + 1].pixel - samples_[i].pixel;
    piece.A = 0.5 * (informations_[i] + informations_[i + 1]);
    piece.As = piece.A * piece.s;
    piece.ss = piece.s.dot(piece.As);
  }
}

// On the piece from a to a + s, the nearest place in the metric A = C^-1 is at t = s.A d / s.A s, d = pixel -
// a.
double EpipolarBand::distance(const Eigen::Vector2d& pixel_F) const {
  double least = 1e300;
  for (std::size_t i = 0; i + 1 < size_; ++i) {
    const Piece& piece = pieces_[i];
    const Vector2 d = pixel_F - samples_[i].pixel;
    const double t = piece.ss > 1e-12 ? std::clamp(d.dot(piece.As) / piece.ss, 0.0, 1.0) : 0.0;
    const Vector2 offset = d - t * piece.s;
    least = std::min(least, offset.dot(piece.A * offset));
  }
  return std::sqrt(least);
}

bool EpipolarBand::inside(const Eigen::Vector2d& pixel_F) const {
  if ((pixel_F.array() < bounds_.min.array()).any() || (pixel_F.array() > bounds_.max.array()).any()) {
    return false;
  }
  return distance(pixel_F) <= n_sigmas_;
}

double EpipolarBand::length() const {
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < size_; ++i)
    sum += (samples_[i + 1].pixel - samples_[i].pixel).norm();
  return sum;
}

}  // namespace cosight::vision
