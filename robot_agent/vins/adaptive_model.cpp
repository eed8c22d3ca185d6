#include "robot_agent/vins/adaptive_model.hpp"

#include <Eigen/LU>
#include <cmath>

namespace cosight::vins {
namespace {

/// root of the information for the weight w = N s / g; w = 1 is the fixed mode.
double sqrt_information(const TrustOptions& options, double w) {
  const double fixed = options.focal_length / options.pixel_noise;
  switch (options.information) {
    case InformationReading::kScalesInformation:
      return fixed * std::sqrt(w);
    case InformationReading::kAsPrinted:
      return std::sqrt(fixed * w);
    case InformationReading::kScalesRoot:
      break;
  }
  return fixed * w;
}

double huber_threshold(const TrustOptions& options, double N) {
  return options.huber_scale * (options.threshold == ThresholdReading::kRoot ? std::sqrt(N) : N);
}

}  // namespace

const char* to_string(TrustMode mode) {
  switch (mode) {
    case TrustMode::kFixed:
      return "vins";
    case TrustMode::kGeometry:
      return "ac_g";
    case TrustMode::kTracking:
      return "ac_gn";
    case TrustMode::kRobust:
      return "ac_me";
    case TrustMode::kGuarded:
      break;
  }
  return "ac_me_guarded";
}

double geometry_factor(const std::vector<Eigen::Vector3d>& directions) {
  if (directions.size() < 3) return 0.0;
  Eigen::Matrix3d HtH = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& direction : directions)
    HtH += direction * direction.transpose();
  Eigen::Matrix3d Q;
  bool invertible = false;
  HtH.computeInverseWithCheck(Q, invertible, 1e-9);
  return invertible && Q.trace() > 0.0 ? std::sqrt(Q.trace()) : 0.0;
}

Trust trust(const TrustOptions& options, int times_tracked, double g) {
  const double fixed = options.focal_length / options.pixel_noise;
  const bool adaptive = options.mode != TrustMode::kFixed && g > 0.0;
  if (!adaptive) return {fixed, options.fixed_kernel, 1.0};
  const double N = times_tracked;
  switch (options.mode) {
    case TrustMode::kGeometry:
      return {sqrt_information(options, options.geometry_scale / g), options.fixed_kernel, 1.0};
    case TrustMode::kTracking:
      return {sqrt_information(options, N * options.scale / g), options.fixed_kernel, 1.0};
    case TrustMode::kRobust:
      return {sqrt_information(options, N * options.scale / g), Kernel::kHuber, huber_threshold(options, N)};
    case TrustMode::kFixed:
    case TrustMode::kGuarded:
      break;
  }
  return {fixed, options.fixed_kernel, 1.0};
}

}  // namespace cosight::vins
