#include "robot_agent/wearer/yaw_offset.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cosight::wearer {
namespace {

double wrapped(double angle) {
  return std::remainder(angle, 2.0 * std::numbers::pi);
}

/// Deviation of an angle of which nothing is known: uniform on the circle.
const double kUnknown = std::numbers::pi / std::sqrt(3.0);

}  // namespace

YawOffset::YawOffset(const YawOffsetOptions& options)
    : options_(options),
      angle_(wrapped(options.prior.angle)),
      variance_(std::min(options.prior.sigma * options.prior.sigma, kUnknown * kUnknown)) {}

double YawOffset::variance_at(Stamp stamp) const {
  const double dt = stamp_ ? std::max(0.0, to_seconds(stamp - *stamp_)) : 0.0;
  return std::min(variance_ + options_.drift * options_.drift * dt, kUnknown * kUnknown);
}

UncertainAngle YawOffset::yaw_WA() const {
  return {angle_, std::sqrt(variance_)};
}

UncertainAngle YawOffset::yaw_WA(Stamp stamp) const {
  return {angle_, std::sqrt(variance_at(stamp))};
}

void YawOffset::advance(Stamp stamp) {
  variance_ = variance_at(stamp);
  stamp_ = std::max(stamp, stamp_.value_or(stamp));
}

YawReport YawOffset::innovation(double z, double R) const {
  YawReport report;
  report.innovation = wrapped(z - angle_);
  report.sigma = std::sqrt(variance_ + R);
  report.nis = report.innovation * report.innovation / (variance_ + R);
  return report;
}

void YawOffset::fuse(YawReport& report, double R) {
  const double K = variance_ / (variance_ + R);
  angle_ = wrapped(angle_ + K * report.innovation);
  variance_ *= 1.0 - K;
  report.outcome = YawReport::Outcome::kFused;
}

YawReport YawOffset::sighting(Stamp stamp, const Eigen::Quaterniond& q_WF, const Eigen::Matrix3d& covariance,
                              const Eigen::Quaterniond& q_AF) {
  const bool usable = q_WF.coeffs().allFinite() && q_AF.coeffs().allFinite() &&
                      std::isfinite(covariance(2, 2)) && covariance(2, 2) >= 0.0;
  if (!usable) return {};
  advance(stamp);
  const Eigen::Quaterniond q_WA = q_WF * q_AF.conjugate();
  const double R = covariance(2, 2) + options_.ahrs_sigma * options_.ahrs_sigma;
  YawReport report = innovation(2.0 * std::atan2(q_WA.z(), q_WA.w()), R);
  if (report.nis < options_.gate) {
    gated_in_a_row_ = 0;
    fuse(report, R);
  } else {
    report.outcome = YawReport::Outcome::kGated;
    gated(report);
  }
  return report;
}

void YawOffset::gated(const YawReport& report) {
  if (++gated_in_a_row_ < options_.gated_until_jump) return;
  variance_ = std::min(variance_ + report.innovation * report.innovation, kUnknown * kUnknown);
  gated_in_a_row_ = 0;
}

}  // namespace cosight::wearer
