#include "robot_agent/slam/wearer_matcher.hpp"

#include <numbers>

#include "robot_agent/slam/rig_refinement.hpp"

namespace cosight::slam {
namespace {

/// An orientation of Cf that leaves wide bands to search.
bool has_wide_bands(const UncertainPose& T_SF) {
  constexpr double kWide = 0.4 * std::numbers::pi / 180.0;
  return T_SF.covariance.bottomRightCorner<3, 3>().trace() > 3.0 * kWide * kWide;
}

}  // namespace

WearerMatcher::WearerMatcher(const PseudoStereoOptions& options, double pixel_sigma, int min_distance_px,
                             std::uint32_t seed)
    : options_(options),
      seed_(seed),
      pseudo_stereo_(options, pixel_sigma),
      new_points_(options, min_distance_px) {}

WornMatches WearerMatcher::match(StereoView& view, const GrayImage& image_S,
                                 const std::vector<Sighting>& sightings, const ekf::Filter& filter,
                                 LandmarkTracks& tracks, bool is_start, PseudoStereoCounts& counts) {
  WornMatches matches;
  if (is_start) new_points_.forget_refusals();
  matches.landmarks = pseudo_stereo_.match(view, image_S, sightings, filter, tracks, counts);
  if (!options_.refine_wearer_pose) return matches;
  std::vector<ekf::StereoMatch> evidence;
  std::vector<Eigen::Vector2d> occupied;
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    occupied.push_back(sightings[i].pixel);
    if (matches.landmarks[i]) evidence.push_back(*matches.landmarks[i]);
  }
  const auto known = static_cast<int>(evidence.size());
  matches.corners = corners_for(view, image_S, occupied, known, is_start);
  for (const Guess& guess : matches.corners)
    evidence.push_back(guess.point.match);

  RigRefinementOptions refinement;
  refinement.seed = seed_;
  constexpr int kInliersAtStart = 10;  // the scale of the whole run hangs on this pose
  if (is_start) refinement.min_inliers = kInliersAtStart;
  const auto refined = refine_rig(view.rig, evidence, refinement);
  if (!refined) {
    matches.corners.clear();
    return matches;
  }
  view.rig.T_SF = refined->T_SF;
  auto is_inlier = refined->is_inlier.begin();
  for (auto& match : matches.landmarks) {
    if (!match || *is_inlier++ != 0) continue;
    match.reset();
    ++counts.epipolar;
  }
  std::erase_if(matches.corners, [&is_inlier](const Guess&) { return *is_inlier++ == 0; });
  return matches;
}

std::vector<Guess> WearerMatcher::corners_for(const StereoView& view, const GrayImage& image_S,
                                              const std::vector<Eigen::Vector2d>& occupied, int known,
                                              bool is_start) {
  const int missing = options_.min_refining_matches - known;
  if (missing <= 0 || !has_wide_bands(view.rig.T_SF)) return {};
  constexpr int kTriesAtStart = 96;  // the more agree, the better the scale of the whole run
  return new_points_.guesses(view, image_S, occupied, is_start ? kTriesAtStart : 2 * options_.max_new_tries);
}

std::vector<NewPoint> WearerMatcher::new_points(const StereoView& view, const GrayImage& image_S,
                                                const WornMatches& matches,
                                                const std::vector<Eigen::Vector2d>& occupied,
                                                const NewPoints::Budget& budget, PseudoStereoCounts& counts) {
  if (!matches.corners.empty()) return new_points_.judge(view, matches.corners, budget.points, counts);
  return new_points_.find(view, image_S, occupied, budget, counts);
}

}  // namespace cosight::slam
