#include "robot_agent/slam/collaborative_slam.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "shared/evaluation/trajectory_errors.hpp"
#include "tests/robot_agent/slam/two_camera_world.hpp"

namespace cosight::slam {
namespace {

const TwoCameraWorld& world() {
  return TwoCameraWorld::instance();
}

std::vector<FrameEstimate> run(CollaborativeSlam& slam, int first, int last) {
  std::vector<FrameEstimate> estimates;
  for (int frame = first; frame < last; ++frame)
    estimates.push_back(slam.process(world().bundle(frame)));
  return estimates;
}

std::vector<FrameEstimate> run_without_wearer(CollaborativeSlam& slam, int first, int last) {
  std::vector<FrameEstimate> estimates;
  for (int frame = first; frame < last; ++frame)
    estimates.push_back(slam.process(world().without_wearer(frame)));
  return estimates;
}

CollaborativeSlam collaborative() {
  return CollaborativeSlam(world().camera(), world().options());
}

double position_error(const FrameEstimate& estimate, int frame) {
  return (estimate.T_WS.T.p - world().T_WS(frame).p).norm();
}

double position_std(const FrameEstimate& estimate) {
  return std::sqrt(estimate.T_WS.covariance.topLeftCorner<3, 3>().trace());
}

int points_fused(const std::vector<FrameEstimate>& estimates) {
  int fused = 0;
  for (const FrameEstimate& estimate : estimates)
    fused += estimate.pseudo_stereo.fused;
  return fused;
}

int sum_of_ends(const PseudoStereoCounts& counts) {
  return counts.ratio_test + counts.epipolar + counts.too_little_parallax + counts.chi_squared +
         counts.joint_compatibility + counts.fused + counts.initialised + counts.redundant;
}

void expect_sound(const FrameEstimate& estimate) {
  ASSERT_TRUE(estimate.T_WS.T.p.allFinite() && estimate.T_WS.T.q.coeffs().allFinite());
  ASSERT_TRUE(estimate.v_W.allFinite() && estimate.omega_S.allFinite());
  EXPECT_NEAR(estimate.T_WS.T.q.norm(), 1.0, 1e-9);
  ASSERT_TRUE(estimate.T_WS.covariance.allFinite() && estimate.twist_covariance.allFinite());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(estimate.T_WS.covariance);
  EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-9 * eigen.eigenvalues().maxCoeff());
}

void expect_identical(const FrameEstimate& a, const FrameEstimate& b) {
  EXPECT_EQ(a.T_WS.T.p, b.T_WS.T.p);
  EXPECT_EQ(a.T_WS.T.q.coeffs(), b.T_WS.T.q.coeffs());
  EXPECT_EQ(a.T_WS.covariance, b.T_WS.covariance);
  EXPECT_EQ(a.v_W, b.v_W);
  EXPECT_EQ(a.omega_S, b.omega_S);
  EXPECT_EQ(a.twist_covariance, b.twist_covariance);
  EXPECT_EQ(a.tracking, b.tracking);
  EXPECT_EQ(a.pseudo_stereo_outcome, b.pseudo_stereo_outcome);
  EXPECT_EQ(a.pseudo_stereo.described, b.pseudo_stereo.described);
  EXPECT_EQ(a.pseudo_stereo.fused, b.pseudo_stereo.fused);
  EXPECT_EQ(a.search.fused_pixels, b.search.fused_pixels);
  EXPECT_EQ(a.landmarks, b.landmarks);
  EXPECT_EQ(a.candidates, b.candidates);
  EXPECT_EQ(a.innovation_rms_px, b.innovation_rms_px);
  EXPECT_EQ(a.nis_per_dof, b.nis_per_dof);
  EXPECT_EQ(a.overlap.far_depth, b.overlap.far_depth);
  EXPECT_EQ(a.overlap.roi_in_S, b.overlap.roi_in_S);
}

TEST(CollaborativeSlam, HoldsMetricScaleFromTheFirstOverlapWithoutATarget) {
  CollaborativeSlam slam = collaborative();
  const auto estimates = run(slam, 0, 31);
  EXPECT_EQ(estimates.front().tracking, Tracking::kTracking);
  EXPECT_GE(estimates.front().pseudo_stereo.initialised, 8);
  for (int frame = 1; frame <= 30; ++frame) {
    const FrameEstimate& estimate = estimates[static_cast<std::size_t>(frame)];
    expect_sound(estimate);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << frame;
    EXPECT_EQ(estimate.pseudo_stereo_outcome, PseudoStereoOutcome::kMatched) << frame;
    EXPECT_LT(position_error(estimate, frame), 0.01 + 0.02 * world().path_length(0, frame)) << frame;
  }
  EXPECT_GT(points_fused(estimates), 100);
}

/// The wearer's orientation by an AHRS whose north is `north` [rad] beside W's.
FrameBundle with_ahrs(int frame, double north) {
  FrameBundle bundle = world().bundle(frame);
  bundle.wearer->has_orientation = false;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(-north, Eigen::Vector3d::UnitZ()));
  bundle.wearer->q_WF = turn * world().T_WF(frame).q;
  bundle.wearer->q_WF_covariance = 1e-5 * Eigen::Matrix3d::Identity();
  return bundle;
}

TEST(CollaborativeSlam, FindsHowTheAhrsIsTurnedAgainstTheMap) {
  constexpr double kNorth = 0.05;  // 2.9 degrees
  SlamOptions options = world().options();
  options.yaw_offset.prior = {0.0, 0.06};
  CollaborativeSlam slam(world().camera(), options);
  FrameEstimate estimate;
  for (int frame = 0; frame <= 30; ++frame)
    estimate = slam.process(with_ahrs(frame, kNorth));
  EXPECT_NEAR(estimate.yaw_offset, kNorth, 0.015);
  EXPECT_LT(estimate.yaw_offset_sigma, 0.02);
  EXPECT_LT(position_error(estimate, 30), 0.01 + 0.03 * world().path_length(0, 30));
}

TEST(CollaborativeSlam, AWrongBaselineGivesAWrongScale) {  // so the scale is the wearer's, not a guess
  CollaborativeSlam slam = collaborative();
  FrameEstimate last;
  for (int frame = 0; frame <= 30; ++frame) {
    FrameBundle bundle = world().bundle(frame);
    bundle.wearer->T_SF.T.p *= 1.2;
    last = slam.process(bundle);
  }
  const double travelled = (last.T_WS.T.p - world().T_WS(0).p).norm();
  EXPECT_NEAR(travelled / (world().T_WS(30).p - world().T_WS(0).p).norm(), 1.2, 0.05);
}

TEST(CollaborativeSlam, TheSameBundlesGiveTheSameBits) {
  CollaborativeSlam first = collaborative();
  Stamp now = 0;
  CollaborativeSlam second(world().camera(), world().options(), {}, [&now] { return now += 1'000'000; });
  const auto a = run(first, 0, 20);
  const auto b = run(second, 0, 20);
  for (std::size_t i = 0; i < a.size(); ++i) {
    SCOPED_TRACE(i);
    expect_identical(a[i], b[i]);
    EXPECT_EQ(a[i].timings.total, 0.0);
    EXPECT_GT(b[i].timings.total, 0.0);
  }
}

TEST(CollaborativeSlam, StartsFromKnownPointsWithoutAWearer) {
  ASSERT_GE(world().known_points().size(), 8U);
  SlamOptions options = world().options();
  options.mode = Mode::kMono;
  options.start.T_WS = Pose{};  // the points alone say where the camera is
  CollaborativeSlam slam(world().camera(), options, world().known_points());
  const auto estimates = run_without_wearer(slam, 0, 20);
  EXPECT_EQ(estimates.front().tracking, Tracking::kTracking);
  EXPECT_LT(position_error(estimates.front(), 0), 0.03);
  const double allowed = 0.03 + 0.05 * world().path_length(0, 19);
  EXPECT_LT(position_error(estimates.back(), 19), allowed);
  EXPECT_EQ(points_fused(estimates), 0);
}

TEST(CollaborativeSlam, AnAssumedDepthGivesTheShapeOfTheWayWithoutItsScale) {
  const TwoCameraWorld& world = TwoCameraWorld::instance();
  SlamOptions options = world.options();
  options.start.assumed_depth = 3.0;
  CollaborativeSlam slam(world.camera(), options);
  std::vector<PosePair> pairs;
  for (int i = 0; i < TwoCameraWorld::kFrames; ++i) {
    const FrameEstimate estimate = slam.process(world.without_wearer(i));
    EXPECT_EQ(estimate.tracking, Tracking::kTracking) << i;
    pairs.push_back({estimate.stamp, estimate.T_WS.T, world.T_WS(i)});
  }
  const double way = world.path_length(0, TwoCameraWorld::kFrames - 1);
  EXPECT_LT(statistics_of(position_errors(aligned(pairs, *align(pairs, Alignment::kSim3)))).rmse, 0.05 * way);
}

TEST(CollaborativeSlam, RefusesAStartFromFewerThanFourKnownPoints) {
  auto points = world().known_points();
  points.resize(3);
  CollaborativeSlam slam(world().camera(), world().options(), points);
  const auto estimates = run_without_wearer(slam, 0, 3);
  for (const FrameEstimate& estimate : estimates) {
    EXPECT_EQ(estimate.tracking, Tracking::kWaitingForScale);
    EXPECT_EQ(estimate.landmarks, 0);
    expect_identical(estimate, [&] {
      FrameEstimate unmoved = estimates.front();
      unmoved.stamp = estimate.stamp;
      return unmoved;
    }());
  }
  points.push_back(world().known_points()[3]);
  CollaborativeSlam with_four(world().camera(), world().options(), points);
  EXPECT_EQ(with_four.process(world().without_wearer(0)).tracking, Tracking::kTracking);
}

TEST(CollaborativeSlam, AFrameWithoutImageOnlyPredicts) {
  CollaborativeSlam slam = collaborative();
  const FrameEstimate before = run(slam, 0, 12).back();
  const FrameEstimate predicted = slam.process(world().without_image(12));
  expect_sound(predicted);
  EXPECT_TRUE(predicted.T_WS.T.p.isApprox(before.T_WS.T.p + 0.1 * before.v_W, 1e-9));
  EXPECT_EQ(predicted.v_W, before.v_W);
  EXPECT_EQ(predicted.pseudo_stereo.described, 0);
  EXPECT_EQ(predicted.search.searched, 0);
  EXPECT_EQ(predicted.landmarks, before.landmarks);
  EXPECT_GT(position_std(predicted), position_std(before));
  const FrameEstimate after = slam.process(world().bundle(13));
  EXPECT_EQ(after.tracking, Tracking::kTracking);
  EXPECT_LT(position_error(after, 13), 0.05);
}

TEST(CollaborativeSlam, SurvivesARepeatedStampAStampThatGoesBackAndAMinuteOfNothing) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 10);
  Stamp stamp = world().bundle(9).stamp;
  int frame = 10;
  for (const Stamp step : {Stamp{0}, -3 * TwoCameraWorld::kInterval, TwoCameraWorld::kInterval,
                           60 * kNanosecondsPerSecond, TwoCameraWorld::kInterval}) {
    FrameBundle bundle = world().bundle(frame);
    bundle.stamp = stamp += step;
    SCOPED_TRACE(frame);
    expect_sound(slam.process(bundle));
    ++frame;
  }
  for (; frame < 30; ++frame) {
    FrameBundle bundle = world().bundle(frame);
    bundle.stamp = stamp += TwoCameraWorld::kInterval;
    expect_sound(slam.process(bundle));
  }
}

TEST(CollaborativeSlam, TheWearerOutOfSightLeavesMoreDoubtAndBackInSightIsFusedAgain) {
  CollaborativeSlam slam = collaborative();
  const auto seen = run(slam, 0, 10);
  EXPECT_GT(points_fused(seen), 0);
  const auto hidden = run_without_wearer(slam, 10, 32);
  EXPECT_EQ(points_fused(hidden), 0);
  CollaborativeSlam always_seen = collaborative();
  EXPECT_GT(position_std(hidden.back()), 1.1 * position_std(run(always_seen, 0, 32).back()));
  EXPECT_EQ(hidden.back().tracking, Tracking::kTracking);
  const auto again = run(slam, 32, 36);
  EXPECT_GT(points_fused(again), 0);
  EXPECT_LT(position_error(again.back(), 35), 0.01 + 0.03 * world().path_length(0, 35));
}

TEST(CollaborativeSlam, MonoUsesTheWearerForTheScaleAndNeverAgain) {
  SlamOptions options = world().options();
  options.mode = Mode::kMono;
  CollaborativeSlam slam(world().camera(), options);
  const auto start = run(slam, 0, 4);  // overlap_s is 0.35 s
  EXPECT_GE(start.front().pseudo_stereo.initialised, 8);
  const auto later = run(slam, 4, 20);
  for (const FrameEstimate& estimate : later) {
    EXPECT_EQ(estimate.pseudo_stereo.described, 0);
    EXPECT_EQ(estimate.pseudo_stereo_outcome, PseudoStereoOutcome::kNoWearerImage);
  }
}

/// The robot's lens is covered, and nothing comes from the wearer.
FrameBundle in_the_dark(int frame) {
  FrameBundle bundle = world().without_wearer(frame);
  auto black = std::make_shared<GrayImage>(*bundle.image);
  std::fill(black->data.begin(), black->data.end(), std::uint8_t{0});
  bundle.image = black;
  return bundle;
}

TEST(CollaborativeSlam, LostItSaysSoWithinASecondAndBeginsAnewWhereTheMotionLed) {
  CollaborativeSlam slam = collaborative();
  const auto before = run(slam, 0, 12);
  const std::size_t mapped = slam.map().size();
  std::vector<FrameEstimate> dark;
  for (int frame = 12; frame < 30; ++frame)
    dark.push_back(slam.process(in_the_dark(frame)));
  EXPECT_EQ(dark[9].tracking, Tracking::kLost) << "a second after the light went out";
  EXPECT_EQ(dark.back().resets, 1);
  EXPECT_GE(slam.map().size(), mapped) << "what was mapped stays in the map";
  const auto after = run(slam, 30, 40);
  for (const FrameEstimate& estimate : after) {
    expect_sound(estimate);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking);
    EXPECT_EQ(estimate.resets, 1);
  }
  const Eigen::Vector3d moved = after.back().T_WS.T.p - after.front().T_WS.T.p;
  const Eigen::Vector3d truly = world().T_WS(39).p - world().T_WS(30).p;
  EXPECT_LT((moved - truly).norm(), 0.15 * truly.norm()) << "metric again, by the wearer";
  EXPECT_LT(position_error(after.front(), 30), 3.0 * position_std(after.front()))
      << "and no farther off than it says";
  EXPECT_GT(position_std(after.front()), 10.0 * position_std(before.back()))
      << "and it admits the way in the dark";
}

TEST(CollaborativeSlam, AFewMatchesFarFromTheirPredictionsAreNotBelieved) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 12);
  // Of the next image only a window around one landmark is left, 7 px to the right of where it was.
  const FrameBundle next = world().without_wearer(12);
  const auto predicted = slam.filter().predict_pixel(slam.filter().landmark_id(0));
  ASSERT_TRUE(predicted);
  FrameBundle window = in_the_dark(12);
  auto image = std::make_shared<GrayImage>(*window.image);
  constexpr int kHalf = 30;
  constexpr int kShift = 7;
  const int u = static_cast<int>(predicted->pixel.x());
  const int v = static_cast<int>(predicted->pixel.y());
  for (int y = std::max(0, v - kHalf); y < std::min(image->height, v + kHalf); ++y) {
    for (int x = std::max(0, u - kHalf); x < std::min(image->width - kShift, u + kHalf); ++x)
      image->row(y)[x + kShift] = next.image->row(y)[x];
  }
  window.image = image;
  const FrameEstimate estimate = slam.process(window);
  EXPECT_EQ(estimate.search.fused_pixels, 0);
  EXPECT_GT(estimate.search.chi_squared, 0);
}

TEST(CollaborativeSlam, LostWithoutAWearerItGoesOnInTheUsualDepth) {
  SlamOptions options = world().options();
  options.mode = Mode::kMono;
  CollaborativeSlam slam(world().camera(), options);
  run(slam, 0, 12);
  for (int frame = 12; frame < 30; ++frame)
    slam.process(in_the_dark(frame));
  const auto after = run_without_wearer(slam, 30, 40);
  EXPECT_EQ(after.front().tracking, Tracking::kTracking);
  EXPECT_EQ(after.back().tracking, Tracking::kTracking);
  EXPECT_EQ(after.back().resets, 1);
}

TEST(WhyNoMatch, SaysThatNoWornImageOrNoPoseCame) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 4);
  FrameBundle bundle = world().without_wearer(4);
  EXPECT_EQ(slam.process(bundle).pseudo_stereo_outcome, PseudoStereoOutcome::kNoWearerImage);
  bundle = world().without_wearer(5);
  bundle.wearer_pose_missing = true;
  EXPECT_EQ(slam.process(bundle).pseudo_stereo_outcome, PseudoStereoOutcome::kNoWearerPose);
  bundle = world().bundle(6);
  bundle.wearer->has_orientation = false;  // and no AHRS
  EXPECT_EQ(slam.process(bundle).pseudo_stereo_outcome, PseudoStereoOutcome::kNoWearerPose);
}

TEST(WhyNoMatch, SaysThatAWornFrameIsNotDue) {
  SlamOptions options = world().options();
  options.pseudo_stereo.interval_s = 0.25;
  CollaborativeSlam slam(world().camera(), options);
  std::vector<PseudoStereoOutcome> outcomes;
  for (int frame = 0; frame < 5; ++frame)
    outcomes.push_back(slam.process(world().bundle(frame)).pseudo_stereo_outcome);
  using enum PseudoStereoOutcome;
  EXPECT_EQ(outcomes, (std::vector{kMatched, kNotDue, kNotDue, kMatched, kNotDue}));  // 10 Hz
}

TEST(WhyNoMatch, SaysThatCamerasBackToBackShareNothing) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 4);
  FrameBundle bundle = world().bundle(4);
  bundle.wearer->T_SF.T.q = Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitY());
  bundle.wearer->T_SF.T.p = {0.0, 0.0, -0.5};
  const FrameEstimate estimate = slam.process(bundle);
  EXPECT_EQ(estimate.pseudo_stereo_outcome, PseudoStereoOutcome::kNoOverlap);
  EXPECT_EQ(estimate.pseudo_stereo.described, 0);
}

TEST(WhyNoMatch, SaysWhereTheLastMatchFellWhenThePoseIsWrong) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 4);
  FrameBundle bundle = world().bundle(4);  // turned by far more than its covariance admits
  bundle.wearer->T_SF.T.q = Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitX()) * bundle.wearer->T_SF.T.q;
  const FrameEstimate estimate = slam.process(bundle);
  EXPECT_LE(estimate.pseudo_stereo.fused, 2);
  EXPECT_LT(position_error(estimate, 4), 0.03);
  EXPECT_EQ(estimate.pseudo_stereo.described, sum_of_ends(estimate.pseudo_stereo));
}

class EveryMatching : public testing::TestWithParam<Matching> {};

TEST_P(EveryMatching, CountsEachDescribedFeatureOnceAndKeepsTheScale) {
  SlamOptions options = world().options();
  options.pseudo_stereo.matching = GetParam();
  options.map.max_landmarks = 30;  // soon full: the redundant ones must be counted, too
  CollaborativeSlam slam(world().camera(), options);
  FrameEstimate last;
  int described = 0;
  for (int frame = 0; frame < 20; ++frame) {
    FrameBundle bundle = frame % 5 == 3 ? world().without_wearer(frame) : world().bundle(frame);
    if (frame % 5 == 4) bundle.wearer->T_SF.T.p.x() += 0.02;
    last = slam.process(bundle);
    described += last.pseudo_stereo.described;
    EXPECT_EQ(last.pseudo_stereo.described, sum_of_ends(last.pseudo_stereo)) << frame;
    EXPECT_LE(last.landmarks, 50) << frame;
  }
  EXPECT_GT(described, 0);
  EXPECT_LT(position_error(last, 19), 0.05 + 0.05 * world().path_length(0, 19));
}

INSTANTIATE_TEST_SUITE_P(Matchings, EveryMatching,
                         testing::Values(Matching::kBand, Matching::kOrb, Matching::kSift, Matching::kSurf));

TEST(CollaborativeSlam, AnOrientationFromTheAhrsDoesWhatOneInThePoseDoes) {
  CollaborativeSlam with_pose = collaborative();
  CollaborativeSlam with_ahrs = collaborative();
  int fused_by_pose = 0;
  int fused_by_ahrs = 0;
  for (int frame = 0; frame < 25; ++frame) {
    FrameBundle bundle = world().bundle(frame);
    const FrameEstimate by_pose = with_pose.process(bundle);
    bundle.wearer->has_orientation = false;
    bundle.wearer->q_WF = world().T_WF(frame).q;
    bundle.wearer->q_WF_covariance = bundle.wearer->T_SF.covariance.bottomRightCorner<3, 3>();
    bundle.wearer->T_SF.T.q = Eigen::Quaterniond(0.0, 0.0, 1.0, 0.0);  // must not be read
    const FrameEstimate by_ahrs = with_ahrs.process(bundle);
    EXPECT_LT((by_pose.T_WS.T.p - by_ahrs.T_WS.T.p).norm(), 0.02) << frame;
    if (frame > 3) {  // before, how the robot turns is not known well enough for the AHRS to say R_SF
      fused_by_pose += by_pose.pseudo_stereo.fused;
      fused_by_ahrs += by_ahrs.pseudo_stereo.fused;
    }
  }
  // The robot's own rotation error is in R_SF then: a wider band, and fewer places in it that are clear.
  EXPECT_GT(2 * fused_by_ahrs, fused_by_pose);
  EXPECT_GT(fused_by_pose, 0);
}

}  // namespace
}  // namespace cosight::slam
