#include "robot_agent/frame_estimate.hpp"

namespace cosight {

const char* to_string(PseudoStereoOutcome outcome) {
  switch (outcome) {
    case PseudoStereoOutcome::kMatched:
      return "matched";
    case PseudoStereoOutcome::kNotDue:
      return "not_due";
    case PseudoStereoOutcome::kNoWearerImage:
      return "no_wearer_image";
    case PseudoStereoOutcome::kNoWearerPose:
      return "no_wearer_pose";
    case PseudoStereoOutcome::kNoOverlap:
      return "no_overlap";
    case PseudoStereoOutcome::kNoFeaturesInRoi:
      return "no_features_in_roi";
    case PseudoStereoOutcome::kRatioTest:
      return "ratio_test";
    case PseudoStereoOutcome::kEpipolar:
      return "epipolar";
    case PseudoStereoOutcome::kTooLittleParallax:
      return "too_little_parallax";
    case PseudoStereoOutcome::kChiSquared:
      return "chi_squared";
    case PseudoStereoOutcome::kJointCompatibility:
      return "joint_compatibility";
  }
  return "unknown";
}

const char* to_string(Tracking tracking) {
  switch (tracking) {
    case Tracking::kWaitingForScale:
      return "waiting_for_scale";
    case Tracking::kTracking:
      return "tracking";
    case Tracking::kLost:
      return "lost";
  }
  return "unknown";
}

}  // namespace cosight
