#include "robot_agent/vision/epipolar_band.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "robot_agent/vision/band_search.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vision/synthetic_plane.hpp"

namespace cosight::vision {
namespace {

constexpr double kDegree = M_PI / 180.0;

UncertainPose wearer_at(const Pose& T_SF, double sigma_p, double sigma_theta) {
  UncertainPose pose{T_SF, {}};
  pose.covariance.setZero();
  pose.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_p * sigma_p),
      Eigen::Vector3d::Constant(sigma_theta * sigma_theta);
  return pose;
}

struct Scene {
  CameraModel camera_S = slam_camera();
  CameraModel camera_F = worn_camera();
  std::mt19937 random;
  std::normal_distribution<double> normal;

  explicit Scene(unsigned seed) : random(seed) {}

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); }

  Pose draw_wearer() {
    const Eigen::Vector3d p(uniform(-0.8, 0.8), uniform(-0.3, 0.3), uniform(-0.3, 0.5));
    return {quaternion_exp({uniform(-0.1, 0.1), -0.35 * p.x(), uniform(-0.3, 0.3)}), p};
  }

  /// The true pose behind an estimate: the error lies in the axes of S.
  Pose disturbed(const UncertainPose& T_SF) {
    Eigen::Matrix<double, 6, 1> error;
    for (int k = 0; k < 6; ++k)
      error(k) = std::sqrt(T_SF.covariance(k, k)) * normal(random);
    return {quaternion_exp(error.tail<3>()) * T_SF.T.q, T_SF.T.p + error.head<3>()};
  }
};

struct Rate {
  int inside = 0;
  int total = 0;
  double share() const { return static_cast<double>(inside) / total; }
};

/// How often the true match, seen with noise from a pose drawn around the estimate, is inside the band.
Rate sample_rate(const EpipolarOptions& options, double relative_sigma, double honesty) {
  Scene scene(7);
  Rate rate;
  while (rate.total < 4000) {
    const UncertainPose T_SF = wearer_at(scene.draw_wearer(), 0.03, 1.0 * kDegree);
    const Eigen::Vector2d pixel_S(scene.uniform(20, 350), scene.uniform(20, 235));
    const double distance = scene.uniform(1.0, 8.0);
    const Eigen::Vector3d p_S = distance * scene.camera_S.unproject(pixel_S)->normalized();
    const auto pixel_F = scene.camera_F.project(scene.disturbed(T_SF).inverse() * p_S);
    if (!pixel_F || !scene.camera_F.contains(*pixel_F, 30.0)) continue;
    const auto noise = [&] {
      return Eigen::Vector2d(scene.normal(scene.random), scene.normal(scene.random));
    };
    UncertainPose claimed = T_SF;
    claimed.covariance *= honesty * honesty;
    const double sigma_rho = relative_sigma / distance;
    const auto range = relative_sigma > 0.0 ? InverseDistanceRange::around(
                                                  1.0 / distance + sigma_rho * scene.normal(scene.random),
                                                  sigma_rho, options.n_sigmas, 0.3)
                                            : InverseDistanceRange::between(0.5, 100.0);
    const auto band =
        EpipolarBand::predict(scene.camera_S, scene.camera_F, claimed, pixel_S + noise(), range, options);
    ++rate.total;
    if (band && band->inside(*pixel_F + noise())) ++rate.inside;
  }
  return rate;
}

TEST(EpipolarBand, HoldsTheTrueMatchAtTheStatedRate) {
  EpipolarOptions options;
  options.max_half_width = 500.0;
  options.n_sigmas = 3.0;
  EXPECT_GT(sample_rate(options, 0.0, 1.0).share(), 0.993);
  options.n_sigmas = 2.0;
  const double rate = sample_rate(options, 0.0, 1.0).share();
  EXPECT_NEAR(rate, 0.954, 0.015);  // one dimension: only the distance from the curve counts
}

TEST(EpipolarBand, OfAKnownDistanceHoldsTheTrueMatchAsWell) {
  EpipolarOptions options;
  options.max_half_width = 500.0;
  EXPECT_GT(sample_rate(options, 0.1, 1.0).share(), 0.99);
}

TEST(EpipolarBand, OfAPoseClaimedTooGoodMissesMatches) {
  EpipolarOptions options;
  options.max_half_width = 500.0;
  EXPECT_LT(sample_rate(options, 0.0, 0.3).share(), 0.9);
}

TEST(EpipolarBand, FollowsTheLensOfTheSecondCamera) {
  // Seen with the wide lens, the curve bends; a straight line between its ends would miss the middle.
  const CameraModel camera_S = worn_camera();
  const CameraModel camera_F = slam_camera();
  const UncertainPose T_SF = wearer_at({quaternion_exp({-0.22, 0.0, 0.0}), {-0.5, 0.0, 0.0}}, 0.0, 0.0);
  const Eigen::Vector2d pixel_S(190, 130);
  EpipolarOptions options;
  options.sigma_pixel_S = 0.05;
  options.sigma_pixel_F = 0.1;
  const auto band = EpipolarBand::predict(camera_S, camera_F, T_SF, pixel_S,
                                          InverseDistanceRange::between(0.8, 100.0), options);
  ASSERT_TRUE(band);
  EXPECT_GT(band->length(), 100.0);
  for (double distance = 1.4; distance < 50.0; distance *= 1.3) {
    const Eigen::Vector3d p_S = distance * camera_S.unproject(pixel_S)->normalized();
    EXPECT_TRUE(band->inside(*camera_F.project(T_SF.T.inverse() * p_S))) << distance;
  }
  const Eigen::Vector2d first = band->sample(0).pixel;
  const Eigen::Vector2d last = band->sample(band->size() - 1).pixel;
  EXPECT_FALSE(band->inside(0.5 * (first + last)));
}

TEST(EpipolarBand, IsShortForAKnownDistance) {
  const Scene scene(1);
  const UncertainPose T_SF = wearer_at({Eigen::Quaterniond::Identity(), {0.5, 0.0, 0.0}}, 0.0, 0.0);
  const auto wide = EpipolarBand::predict(scene.camera_S, scene.camera_F, T_SF, {200, 120},
                                          InverseDistanceRange::between(0.5, 100.0));
  const auto narrow = EpipolarBand::predict(scene.camera_S, scene.camera_F, T_SF, {200, 120},
                                            InverseDistanceRange::around(0.4, 0.01, 3.0, 0.5));
  ASSERT_TRUE(wide && narrow);
  EXPECT_LT(narrow->length(), 0.1 * wide->length());
  // f b (rho+ - rho-) = 320 * 0.5 * 0.06, nearly along x
  EXPECT_NEAR(narrow->length(), 9.6, 0.5);
}

TEST(EpipolarBand, IsNothingWhereTheWearerLooksElsewhere) {
  const Scene scene(1);
  const auto range = InverseDistanceRange::between(0.5, 100.0);
  const Pose turned{quaternion_exp({0.0, M_PI, 0.0}), {0.5, 0.0, 0.0}};
  EXPECT_FALSE(
      EpipolarBand::predict(scene.camera_S, scene.camera_F, wearer_at(turned, 0.0, 0.0), {200, 120}, range));
  const Pose aside{quaternion_exp({0.0, 1.5, 0.0}), {0.5, 0.0, 0.0}};
  EXPECT_FALSE(
      EpipolarBand::predict(scene.camera_S, scene.camera_F, wearer_at(aside, 0.0, 0.0), {200, 120}, range));
}

TEST(EpipolarBand, IsAPointWithoutBaseline) {
  const Scene scene(1);
  const auto band = EpipolarBand::predict(scene.camera_S, scene.camera_F, wearer_at({}, 0.0, 0.0), {200, 120},
                                          InverseDistanceRange::between(0.5, 100.0));
  ASSERT_TRUE(band);
  EXPECT_NEAR(band->length(), 0.0, 1e-9);
  EXPECT_TRUE(band->inside(*scene.camera_F.project(*scene.camera_S.unproject({200, 120}))));
}

ImagePyramid pyramid_of(const GrayImage& image) {
  ImagePyramid pyramid;
  build_pyramid(image, pyramid);
  return pyramid;
}

TEST(BandSearch, FindsTheWarpedPatchInTheOtherCamera) {
  Scene scene(3);
  const Eigen::Vector3d p_W(0.1, 0.0, 2.5);
  const TexturedPlane plane{p_W, Eigen::Vector3d(0.1, -0.1, 1.0).normalized(), SyntheticTexture(31, 5.0)};
  const View slam{scene.camera_S, Pose{}};
  const GrayImage image_S = plane.seen_from(slam);
  BandSearch search;
  int found = 0;
  int right = 0;
  constexpr int kTrials = 20;
  for (int trial = 0; trial < kTrials; ++trial) {
    const UncertainPose T_SF = wearer_at(scene.draw_wearer(), 0.02, 0.5 * kDegree);
    const View wearer{scene.camera_F, scene.disturbed(T_SF)};
    const GrayImage image_F = plane.seen_from(wearer);
    const Eigen::Vector2d pixel_S = *scene.camera_S.project(p_W);
    const auto band = EpipolarBand::predict(scene.camera_S, scene.camera_F, T_SF, pixel_S,
                                            InverseDistanceRange::between(1.0, 50.0));
    ASSERT_TRUE(band);
    const ReferencePatch patch = cut_reference(image_S, pixel_S);
    const View believed{scene.camera_F, T_SF.T};
    const PatchMatch match = search.find(pyramid_of(image_F), {patch, slam, slam, believed, pixel_S}, *band);
    if (!match) continue;
    ++found;
    const Eigen::Vector2d pixel_F = *scene.camera_F.project(wearer.T_WC.inverse() * p_W);
    right += (match.pixel - pixel_F).norm() < 0.5 ? 1 : 0;
  }
  EXPECT_GE(found, kTrials - 2);
  EXPECT_EQ(right, found);
}

}  // namespace
}  // namespace cosight::vision
