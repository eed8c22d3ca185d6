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

double guarded_weight(const TrustOptions& options, const FeatureRecord& feature) {
  if (feature.relative_misfit <= options.misfit_width) return 1.0;
  return std::pow(options.misfit_width / feature.relative_misfit, 4);
}

Trust trust(const TrustOptions& options, const FeatureRecord& feature) {
  const double fixed = options.focal_length / options.pixel_noise;
  const double N = feature.times_tracked;
  const double g = feature.geometry_factor;
  if (options.mode == TrustMode::kGuarded) {
    return {fixed * std::sqrt(guarded_weight(options, feature)), options.fixed_kernel, 1.0};
  }
  if (options.mode == TrustMode::kFixed || g <= 0.0) return {fixed, options.fixed_kernel, 1.0};
  if (options.mode == TrustMode::kGeometry) {
    return {sqrt_information(options, options.geometry_scale / g), options.fixed_kernel, 1.0};
  }
  const double root = sqrt_information(options, N * options.scale / g);
  if (options.mode == TrustMode::kTracking) return {root, options.fixed_kernel, 1.0};
  return {root, Kernel::kHuber, huber_threshold(options, N)};
}

}  // namespace cosight::vins
