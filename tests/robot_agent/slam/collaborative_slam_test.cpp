#include "robot_agent/slam/collaborative_slam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shared/evaluation/trajectory_errors.hpp"
#include "tests/robot_agent/slam/world_runs.hpp"

namespace cosight::slam {
namespace {

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
