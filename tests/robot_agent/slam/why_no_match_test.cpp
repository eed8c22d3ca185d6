// Each worn frame says at which stage its last match fell.
#include <gtest/gtest.h>

#include "tests/robot_agent/slam/world_runs.hpp"

namespace cosight::slam {
namespace {

int sum_of_ends(const PseudoStereoCounts& counts) {
  return counts.ratio_test + counts.epipolar + counts.too_little_parallax + counts.chi_squared +
         counts.joint_compatibility + counts.fused + counts.initialised + counts.redundant;
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

}  // namespace
}  // namespace cosight::slam
