#include "robot_agent/slam/stereo_depths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/slam/plain_camera.hpp"

namespace cosight::slam {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Cf 1.2 m ahead of Cs and 0.7 m to its left, its pose known to centimetres.
ekf::StereoRig rig() {
  ekf::StereoRig rig;
  rig.camera_S = rig.camera_F = plain_camera();
  rig.sigma_pixel_S = rig.sigma_pixel_F = 0.5;
  rig.T_SF.T = {quaternion_exp(Vector3d(0.02, 0.1, -0.01)), Vector3d(-0.7, -0.1, 1.2)};
  rig.T_SF.covariance.diagonal() << 4e-4, 4e-4, 4e-4, 1e-6, 1e-6, 1e-6;
  return rig;
}

ekf::StereoMatch match_of(const Vector3d& p_S, const Pose& T_SF) {
  return {*plain_camera().project(p_S), *plain_camera().project(T_SF.inverse() * p_S)};
}

ekf::MeasurementReport report_of(ekf::LandmarkId landmark, ekf::MeasurementKind kind, ekf::Outcome outcome) {
  ekf::MeasurementReport report;
  report.landmark = landmark;
  report.kind = kind;
  report.outcome = outcome;
  return report;
}

/// The depth of one point whose match was believed.
StereoDepth depth_of(const ekf::StereoMatch& match, const ekf::StereoRig& rig) {
  ekf::UpdateReport report;
  report.measurements = {report_of(7, ekf::MeasurementKind::kWearerPixel, ekf::Outcome::kFused)};
  const auto depths = fused_depths(rig, {{7, match.pixel_S}}, {match}, report);
  EXPECT_EQ(depths.size(), 1U);
  return depths.empty() ? StereoDepth{} : depths.front();
}

const Vector3d kSeen(0.6, -0.3, 4.5);

TEST(StereoDepths, AreTheInverseDistancesOfThePoints) {
  const ekf::StereoMatch match = match_of(kSeen, rig().T_SF.T);
  const StereoDepth depth = depth_of(match, rig());
  EXPECT_NEAR(depth.inverse_distance, 1.0 / kSeen.norm(), 1e-9);
  EXPECT_EQ(depth.pixel_S, match.pixel_S);
}

/// Standard deviation of the inverse distance over drawn inputs.
double spread(const std::function<double(std::mt19937_64&)>& draw) {
  constexpr int kDraws = 4000;
  std::mt19937_64 random(11);
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = draw(random);
    sum += x;
    squares += x * x;
  }
  return std::sqrt(squares / kDraws - sum * sum / kDraws / kDraws);
}

TEST(StereoDepths, SayHowFarTheNoiseOfTheirPixelsMovesThem) {
  const ekf::StereoRig exact = rig();
  const ekf::StereoMatch match = match_of(kSeen, exact.T_SF.T);
  std::normal_distribution<double> n(0.0, 0.5);
  const double drawn = spread([&](std::mt19937_64& random) {
    const Vector2d noise_S(n(random), n(random));
    const Vector2d noise_F(n(random), n(random));
    return depth_of({match.pixel_S + noise_S, match.pixel_F + noise_F}, exact).inverse_distance;
  });
  EXPECT_NEAR(depth_of(match, exact).sigma, drawn, 0.06 * drawn);
}

TEST(StereoDepths, SayHowFarTheErrorOfTheWearersPoseMovesThem) {
  const ekf::StereoRig exact = rig();
  const ekf::StereoMatch match = match_of(kSeen, exact.T_SF.T);
  std::normal_distribution<double> n;
  const double drawn = spread([&](std::mt19937_64& random) {
    ekf::StereoRig wrong = exact;
    wrong.T_SF.T.p += 0.02 * Vector3d(n(random), n(random), n(random));
    wrong.T_SF.T.q = quaternion_exp(1e-3 * Vector3d(n(random), n(random), n(random))) * wrong.T_SF.T.q;
    return depth_of(match, wrong).inverse_distance;
  });
  EXPECT_NEAR(depth_of(match, exact).shared_sigma, drawn, 0.06 * drawn);
}

TEST(StereoDepths, AreOnlyOfMatchesThatTheFilterBelieved) {
  using enum ekf::MeasurementKind;
  const ekf::StereoRig exact = rig();
  std::vector<Sighting> sightings;
  PseudoStereo::Matches matches;
  for (ekf::LandmarkId id = 0; id < 4; ++id) {
    const ekf::StereoMatch match =
        match_of(kSeen + 0.1 * static_cast<double>(id) * Vector3d::UnitX(), exact.T_SF.T);
    sightings.push_back({id, match.pixel_S});
    matches.emplace_back(match);
  }
  matches[3].reset();  // not found in Cf
  ekf::UpdateReport report;
  report.measurements = {
      report_of(0, kPixel, ekf::Outcome::kFused), report_of(0, kWearerPixel, ekf::Outcome::kGated),
      report_of(1, kPoint, ekf::Outcome::kFused), report_of(2, kPixel, ekf::Outcome::kFused),
      report_of(3, kPixel, ekf::Outcome::kFused)};
  const auto depths = fused_depths(exact, sightings, matches, report);
  ASSERT_EQ(depths.size(), 1U);
  EXPECT_EQ(depths.front().pixel_S, sightings[1].pixel);
}

}  // namespace
}  // namespace cosight::slam
