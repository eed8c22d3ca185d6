#include "robot_agent/slam/rig_refinement.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "robot_agent/slam/epipolar_error.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/slam/plain_camera.hpp"

namespace cosight::slam {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double kDegree = 0.017453292519943295;

/// A wearer 1.2 m ahead and 0.7 m to the left of the robot, both looking into a room; the sensors' pose of Cf
/// is off by a draw from its own covariance.
class Trial {
 public:
  explicit Trial(std::uint64_t seed) : random_(seed) {
    rig_.camera_S = rig_.camera_F = plain_camera();
    rig_.sigma_pixel_S = rig_.sigma_pixel_F = 0.5;
    rig_.T_SF.covariance.diagonal() << 16e-4, 16e-4, 16e-4, 1e-4, 3e-4, 1e-4;
    Vector6 xi;
    for (int i = 0; i < 6; ++i)
      xi(i) = std::sqrt(rig_.T_SF.covariance(i, i)) * normal_(random_);
    rig_.T_SF.T = {quaternion_exp(xi.tail<3>()) * truth_.q, truth_.p + xi.head<3>()};
  }

  std::vector<ekf::StereoMatch> exact_matches(int count) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<ekf::StereoMatch> result;
    while (static_cast<int>(result.size()) < count) {
      const double depth = 2.5 + 8.0 * share(random_);
      const Eigen::Vector3d p_S(depth * (1.2 * share(random_) - 0.6), depth * (0.8 * share(random_) - 0.4),
                                depth);
      const auto pixel_S = plain_camera().project(p_S);
      const auto pixel_F = plain_camera().project(truth_.inverse() * p_S);
      if (!pixel_S || !pixel_F || !plain_camera().contains(*pixel_S) || !plain_camera().contains(*pixel_F))
        continue;
      result.push_back({*pixel_S, *pixel_F});
    }
    return result;
  }

  std::vector<ekf::StereoMatch> matches(int right, int wrong) {
    std::uniform_real_distribution<double> share(0.0, 1.0);
    std::vector<ekf::StereoMatch> result = exact_matches(right);
    for (ekf::StereoMatch& match : result) {
      match.pixel_S += noise();
      match.pixel_F += noise();
    }
    for (int i = 0; i < wrong; ++i) {
      const Eigen::Vector2d pixel_S(720.0 * share(random_), 480.0 * share(random_));
      const Eigen::Vector2d pixel_F(720.0 * share(random_), 480.0 * share(random_));
      result.push_back({pixel_S, pixel_F});
    }
    return result;
  }

  const ekf::StereoRig& rig() const { return rig_; }
  const Pose& truth() const { return truth_; }
  /// [dp, dtheta] that takes an estimate to the truth.
  Vector6 error_of(const Pose& T_SF) const {
    Vector6 error;
    error.head<3>() = truth_.p - T_SF.p;
    error.tail<3>() = quaternion_log(truth_.q * T_SF.q.conjugate());
    return error;
  }

 private:
  Eigen::Vector2d noise() { return 0.5 * Eigen::Vector2d(normal_(random_), normal_(random_)); }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Pose truth_{quaternion_exp({0.02, -0.15, 0.03}), {-0.7, -0.8, 1.2}};
  ekf::StereoRig rig_;
};

/// The matches of these tests err by their pixel noise alone.
RigRefinementOptions independent() {
  RigRefinementOptions options;
  options.mismatch_px = 0.0;
  options.independent_matches = 1000;
  return options;
}

TEST(RefineRig, BringsTheOrientationToAFractionOfTheSensorsError) {
  double before = 0.0;
  double after = 0.0;
  constexpr int kTrials = 40;
  for (int seed = 1; seed <= kTrials; ++seed) {
    Trial trial(static_cast<std::uint64_t>(seed));
    const auto refined = refine_rig(trial.rig(), trial.matches(40, 0));
    ASSERT_TRUE(refined);
    before += trial.error_of(trial.rig().T_SF.T).tail<3>().squaredNorm();
    after += trial.error_of(refined->T_SF.T).tail<3>().squaredNorm();
  }
  EXPECT_LT(std::sqrt(after), 0.25 * std::sqrt(before));
}

/// Average NEES of pose over many trials, for the noise that is claimed.
double average_nees(const RigRefinementOptions& options) {
  constexpr int kTrials = 200;
  double sum = 0.0;
  for (int seed = 1; seed <= kTrials; ++seed) {
    Trial trial(static_cast<std::uint64_t>(seed));
    const auto refined = refine_rig(trial.rig(), trial.matches(30, 0), options);
    EXPECT_TRUE(refined);
    if (!refined) continue;
    const Vector6 error = trial.error_of(refined->T_SF.T);
    sum += error.dot(refined->T_SF.covariance.ldlt().solve(error));
  }
  return sum / kTrials;
}

// 200 trials of six degrees of freedom: chi-squared(1200) / 200 lies in [5.53, 6.49] in 95 of 100 cases.
TEST(RefineRig, StatesItsOwnError) {
  const double nees = average_nees(independent());
  EXPECT_GT(nees, 5.3);
  EXPECT_LT(nees, 7.0);
}

TEST(EpipolarErrorOfAMatch, HasTheGradientThatNumbersGive) {
  Trial trial(5);
  ekf::StereoRig rig = trial.rig();
  rig.T_SF.T = trial.truth();  // there the error is zero, and that of its weight does not matter
  for (const ekf::StereoMatch& match : trial.exact_matches(20)) {
    const auto pair = rays_of(rig, match);
    ASSERT_TRUE(pair);
    const auto value = [&](const Vector6& xi) {
      const Pose moved{quaternion_exp(xi.tail<3>()) * rig.T_SF.T.q, rig.T_SF.T.p + xi.head<3>()};
      return epipolar_error(*pair, moved, 0.25, 0.5).value;
    };
    EXPECT_NEAR(value(Vector6::Zero()), 0.0, 1e-6);
    Eigen::Matrix<double, 1, 6> numeric;
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 6; ++i)
      numeric(i) = (value(kStep * Vector6::Unit(i)) - value(-kStep * Vector6::Unit(i))) / (2.0 * kStep);
    const auto J = epipolar_error(*pair, rig.T_SF.T, 0.25, 0.5).J;
    EXPECT_LT((J - numeric).norm(), 1e-5 * numeric.norm());
  }
}

TEST(YawByMatches, TakesTheSensorsOutOfTheRefinedPose) {
  // Two Gaussians of one angle about the vertical: the sensors' at 0 and the matches' at 0.03.
  const double p = 4e-4;
  const double r = 1e-4;
  const double q = 1.0 / (1.0 / p + 1.0 / r);
  const Eigen::Matrix3d R_WS = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5).toRotationMatrix();
  const auto pose_of = [&](double yaw, double variance) {
    UncertainPose T_SF;
    T_SF.T.q = quaternion_exp(R_WS.transpose() * Eigen::Vector3d(0.0, 0.0, yaw));
    T_SF.covariance.bottomRightCorner<3, 3>() = variance * Eigen::Matrix3d::Identity();
    return T_SF;
  };
  const auto yaw = yaw_by_matches(pose_of(0.0, p), pose_of(0.03 * q / r, q), R_WS);
  ASSERT_TRUE(yaw);
  EXPECT_NEAR(yaw->angle, 0.03, 1e-12);
  EXPECT_NEAR(yaw->sigma, std::sqrt(r), 1e-12);
  EXPECT_FALSE(yaw_by_matches(pose_of(0.0, p), pose_of(0.0, p), R_WS));
}

TEST(RefineRig, IsCautiousWhereSurfacesAndLensErrAlike) {
  RigRefinementOptions alike = independent();
  alike.independent_matches = RigRefinementOptions{}.independent_matches;
  EXPECT_LT(average_nees(alike), 5.3);
  RigRefinementOptions warped = independent();
  warped.mismatch_px = RigRefinementOptions{}.mismatch_px;
  EXPECT_LT(average_nees(warped), 5.3);
}

TEST(RefineRig, FindsTheAgreeingMatchesAmongWrongOnes) {
  int wrong_kept = 0;
  int far = 0;
  constexpr int kTrials = 40;
  for (int seed = 1; seed <= kTrials; ++seed) {
    Trial trial(static_cast<std::uint64_t>(seed));
    const auto matches = trial.matches(20, 20);
    const auto refined = refine_rig(trial.rig(), matches);
    ASSERT_TRUE(refined) << seed;
    far += trial.error_of(refined->T_SF.T).tail<3>().norm() > 0.6 * kDegree ? 1 : 0;
    for (std::size_t i = 20; i < matches.size(); ++i)
      wrong_kept += refined->is_inlier[i];
  }
  EXPECT_LE(far, kTrials / 20);
  EXPECT_LT(wrong_kept, kTrials * 20 / 20);  // of random pixels, one in twenty lies on its line by chance
}

TEST(RefineRig, IsNothingWhenTheMatchesDoNotAgree) {
  int believed = 0;
  constexpr int kTrials = 40;
  for (int seed = 1; seed <= kTrials; ++seed) {
    Trial trial(static_cast<std::uint64_t>(seed));
    believed += refine_rig(trial.rig(), trial.matches(0, 30)).has_value() ? 1 : 0;
  }
  EXPECT_LE(believed, kTrials / 20);
  Trial trial(1);
  EXPECT_FALSE(refine_rig(trial.rig(), trial.matches(3, 0)));
}

TEST(RefineRig, LeavesAPoseThatIsKnownExactly) {
  Trial trial(3);
  ekf::StereoRig exact = trial.rig();
  const Vector6 error = trial.error_of(exact.T_SF.T);
  exact.T_SF.T = {quaternion_exp(error.tail<3>()) * exact.T_SF.T.q, exact.T_SF.T.p + error.head<3>()};
  exact.T_SF.covariance.setZero();
  const auto refined = refine_rig(exact, trial.matches(30, 0));
  ASSERT_TRUE(refined);
  EXPECT_TRUE(refined->T_SF.T.p.isApprox(exact.T_SF.T.p, 1e-12));
  EXPECT_EQ(refined->T_SF.covariance, Matrix6::Zero());
}

TEST(RefineRig, GivesTheSameForTheSameSeed) {
  Trial a(7);
  Trial b(7);
  const auto first = refine_rig(a.rig(), a.matches(20, 10));
  const auto second = refine_rig(b.rig(), b.matches(20, 10));
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_SF.T.p, second->T_SF.T.p);
  EXPECT_EQ(first->is_inlier, second->is_inlier);
}

}  // namespace
}  // namespace cosight::slam
