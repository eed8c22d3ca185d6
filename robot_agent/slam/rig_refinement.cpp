#include "robot_agent/slam/rig_refinement.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "robot_agent/slam/epipolar_error.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::slam {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

Pose moved(const Pose& T, const Vector6& xi) {
  return {(quaternion_exp(xi.tail<3>()) * T.q).normalized(), T.p + xi.head<3>()};
}

class EpipolarProblem {
 public:
  EpipolarProblem(const ekf::StereoRig& rig, std::span<const ekf::StereoMatch> matches, double mismatch_px)
      : T_prior_(rig.T_SF.T),
        factor_(ekf::covariance_factor(rig.T_SF.covariance)),
        variance_S_(rig.sigma_pixel_S * rig.sigma_pixel_S),
        variance_F_(rig.sigma_pixel_F * rig.sigma_pixel_F + mismatch_px * mismatch_px) {
    for (const ekf::StereoMatch& match : matches)
      pairs_.push_back(rays_of(rig, match));
  }

  std::size_t size() const { return pairs_.size(); }
  bool is_usable(std::size_t i) const { return pairs_[i].has_value(); }
  Pose pose(const Vector6& z) const { return moved(T_prior_, factor_ * z); }
  const Matrix6& factor() const { return factor_; }

  EpipolarError error(std::size_t i, const Pose& T_SF) const {
    return epipolar_error(*pairs_[i], T_SF, variance_S_, variance_F_);
  }

  /// One Gauss-Newton step of z ~ N(0, I), xi = L z, from the given matches with Cauchy's weights beyond
  /// `gate`, each counted as `share` of a match. Leaves the information matrix of z.
  template <class Indices>
  Vector6 step(const Vector6& z, const Indices& indices, double gate, double share,
               Matrix6& information) const {
    const Pose T_SF = pose(z);
    information.setIdentity();
    Vector6 gradient = z;
    for (const std::size_t i : indices) {
      const EpipolarError e = error(i, T_SF);
      const Eigen::Matrix<double, 1, 6> J = e.J * factor_;
      const double weight = share / (1.0 + e.value * e.value / (gate * gate));
      information += weight * J.transpose() * J;
      gradient += weight * e.value * J.transpose();
    }
    return z - information.llt().solve(gradient);
  }

 private:
  Pose T_prior_;
  Matrix6 factor_;
  double variance_S_, variance_F_;
  std::vector<std::optional<RayPair>> pairs_;
};

int mark_inliers(const EpipolarProblem& problem, const Pose& T_SF, double gate,
                 std::vector<char>& is_inlier) {
  int inliers = 0;
  is_inlier.assign(problem.size(), 0);
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (!problem.is_usable(i) || std::abs(problem.error(i, T_SF).value) > gate) continue;
    is_inlier[i] = 1;
    ++inliers;
  }
  return inliers;
}

std::vector<std::size_t> indices_of(const std::vector<char>& flags) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] != 0) indices.push_back(i);
  }
  return indices;
}

/// The cheapest of the poses that three matches and the prior give: |z|^2 and each match's squared error, cut
/// at the gate.
Vector6 best_hypothesis(const EpipolarProblem& problem, const std::vector<std::size_t>& usable,
                        const RigRefinementOptions& options) {
  const double cut = options.gate_sigmas * options.gate_sigmas;
  const auto cost_of = [&](const Vector6& z) {
    const Pose T_SF = problem.pose(z);
    double cost = z.squaredNorm();
    for (const std::size_t i : usable) {
      const double e = problem.error(i, T_SF).value;
      cost += std::min(e * e, cut);
    }
    return cost;
  };
  std::mt19937 random(options.seed);
  Vector6 best = Vector6::Zero();
  double least = cost_of(best);
  Matrix6 information;
  for (int k = 0; k < options.hypotheses; ++k) {
    std::array<std::size_t, 3> sample;
    for (std::size_t& index : sample)
      index = usable[random() % usable.size()];
    Vector6 z = Vector6::Zero();
    constexpr double kNoOutlier = 1e3;
    for (int step = 0; step < 2; ++step)
      z = problem.step(z, sample, kNoOutlier, 1.0, information);
    const double cost = cost_of(z);
    if (!(cost < least)) continue;
    least = cost;
    best = z;
  }
  return best;
}

}  // namespace

std::optional<RefinedRig> refine_rig(const ekf::StereoRig& rig, std::span<const ekf::StereoMatch> matches,
                                     const RigRefinementOptions& options) {
  const EpipolarProblem problem(rig, matches, options.mismatch_px);
  std::vector<std::size_t> usable;
  for (std::size_t i = 0; i < problem.size(); ++i) {
    if (problem.is_usable(i)) usable.push_back(i);
  }
  if (static_cast<int>(usable.size()) < options.min_inliers) return std::nullopt;
  Vector6 z = best_hypothesis(problem, usable, options);
  RefinedRig refined;
  Matrix6 information = Matrix6::Identity();
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    refined.inliers = mark_inliers(problem, problem.pose(z), options.gate_sigmas, refined.is_inlier);
    if (refined.inliers < options.min_inliers) return std::nullopt;
    const double share = std::min(1.0, static_cast<double>(options.independent_matches) / refined.inliers);
    z = problem.step(z, indices_of(refined.is_inlier), options.gate_sigmas, share, information);
  }
  refined.T_SF.T = problem.pose(z);
  refined.inliers = mark_inliers(problem, refined.T_SF.T, options.gate_sigmas, refined.is_inlier);
  if (refined.inliers < options.min_inliers || !(z.squaredNorm() <= options.max_prior_distance) ||
      refined.inliers < options.min_inlier_share * static_cast<double>(usable.size())) {
    return std::nullopt;
  }
  const Matrix6 half = problem.factor() * information.llt().solve(Matrix6::Identity());
  refined.T_SF.covariance = half * problem.factor().transpose();
  return refined;
}

std::optional<wearer::UncertainAngle> yaw_by_matches(const UncertainPose& sensed,
                                                     const UncertainPose& refined,
                                                     const Eigen::Matrix3d& R_WS) {
  constexpr Eigen::Index kYaw = 2;
  const auto yaw_variance = [&](const UncertainPose& T_SF) {
    return (R_WS * T_SF.covariance.bottomRightCorner<3, 3>() * R_WS.transpose())(kYaw, kYaw);
  };
  const double p = yaw_variance(sensed);
  const double q = yaw_variance(refined);
  if (!(q < 0.8 * p)) return std::nullopt;
  const Eigen::Quaterniond step = refined.T.q * sensed.T.q.conjugate();
  return wearer::UncertainAngle{(R_WS * quaternion_log(step))(kYaw)*p / (p - q), std::sqrt(p * q / (p - q))};
}

}  // namespace cosight::slam
