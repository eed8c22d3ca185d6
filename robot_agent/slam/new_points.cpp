#include "robot_agent/slam/new_points.hpp"

#include <algorithm>

#include "robot_agent/slam/pseudo_stereo.hpp"
#include "robot_agent/vision/descriptor_matcher.hpp"
#include "robot_agent/vision/patch_warp.hpp"

namespace cosight::slam {
namespace {

constexpr int kPatchSide = 13;
constexpr int kRest = 10;  ///< frames for which a corner without a match is left alone

vision::CornerOptions corner_options(int min_distance_px) {
  vision::CornerOptions result;
  result.min_distance = min_distance_px;
  return result;
}

std::unique_ptr<vision::DescriptorExtractor> make_extractor(Matching matching) {
  switch (matching) {
    case Matching::kOrb:
      return vision::make_descriptor_extractor(vision::DescriptorKind::kOrb);
    case Matching::kSift:
      return vision::make_descriptor_extractor(vision::DescriptorKind::kSift);
    case Matching::kSurf:
      return vision::make_descriptor_extractor(vision::DescriptorKind::kSurf);
    case Matching::kBand:
      break;
  }
  return nullptr;
}

}  // namespace

NewPoints::NewPoints(const PseudoStereoOptions& options, int min_distance_px)
    : options_(options),
      min_distance_px_(min_distance_px),
      corners_(corner_options(min_distance_px)),
      band_search_(band_search_options(options)),
      refinement_(band_search_options(options)),
      extractor_(make_extractor(options.matching)) {}

std::vector<NewPoint> NewPoints::find(const StereoView& view, const GrayImage& image_S,
                                      const std::vector<Eigen::Vector2d>& occupied, const Budget& budget,
                                      PseudoStereoCounts& counts) {
  rest_refusals();
  if (budget.points <= 0) return {};
  return extractor_ ? find_by_descriptors(view, image_S, occupied, budget.points, counts)
                    : find_by_band(view, image_S, occupied, budget, counts);
}

void NewPoints::rest_refusals() {
  for (Refusal& refusal : refusals_)
    --refusal.frames_left;
  std::erase_if(refusals_, [](const Refusal& refusal) { return refusal.frames_left <= 0; });
}

std::vector<vision::Corner> NewPoints::corners_to_try(const StereoView& view, const GrayImage& image_S,
                                                      std::vector<Eigen::Vector2d> occupied, int tries) {
  for (const Refusal& refusal : refusals_)
    occupied.push_back(refusal.pixel);
  auto corners = corners_.detect(image_S, occupied, tries, &view.overlap.roi_in_S);
  std::erase_if(corners,
                [&](const vision::Corner& corner) { return contains(view.silhouette, corner.pixel); });
  vision::build_pyramid(*view.image_F, pyramid_F_);
  return corners;
}

std::vector<NewPoint> NewPoints::find_by_band(const StereoView& view, const GrayImage& image_S,
                                              const std::vector<Eigen::Vector2d>& occupied,
                                              const Budget& budget, PseudoStereoCounts& counts) {
  std::vector<NewPoint> points;
  for (const vision::Corner& corner : corners_to_try(view, image_S, occupied, budget.tries)) {
    if (static_cast<int>(points.size()) == budget.points) break;
    if (const auto point = match_corner(view, image_S, corner.pixel, counts)) {
      points.push_back(*point);
    } else {
      refusals_.push_back({corner.pixel, kRest});
    }
  }
  return points;
}

std::vector<NewPoint> NewPoints::find_by_descriptors(const StereoView& view, const GrayImage& image_S,
                                                     std::vector<Eigen::Vector2d> occupied, int wanted,
                                                     PseudoStereoCounts& counts) {
  const auto features_S =
      extractor_->detect_and_describe(image_S, view.overlap.roi_in_S, options_.max_features);
  const auto features_F =
      extractor_->detect_and_describe(*view.image_F, view.overlap.roi_in_F, options_.max_features);
  std::vector<std::optional<vision::EpipolarBand>> bands;
  for (const Eigen::Vector2d& pixel : features_S.pixels)
    bands.push_back(band_of(view, pixel));
  vision::MatcherOptions matcher;
  matcher.max_ratio = options_.max_ratio;
  const auto found = vision::match_descriptors(
      features_S, features_F, matcher,
      [&](std::size_t s, std::size_t f) { return bands[s] && bands[s]->inside(features_F.pixels[f]); });
  counts.described += static_cast<int>(features_S.size());
  counts.epipolar += found.counts.no_partner;
  counts.ratio_test += found.counts.too_far + found.counts.ambiguous + found.counts.not_mutual;
  const auto is_free = [&](const Eigen::Vector2d& pixel) {
    return !contains(view.silhouette, pixel) &&
           std::none_of(occupied.begin(), occupied.end(),
                        [&](const auto& other) { return (other - pixel).norm() < min_distance_px_; });
  };
  std::vector<NewPoint> matches;
  for (const vision::DescriptorMatch& pair : found.matches) {
    const ekf::StereoMatch rough{features_S.pixels[pair.index_S], features_F.pixels[pair.index_F]};
    if (static_cast<int>(matches.size()) == wanted || !is_free(rough.pixel_S)) {
      ++counts.redundant;
    } else if (const auto match = refine(view, image_S, rough, counts)) {
      matches.push_back({*match, std::nullopt});
      occupied.push_back(match->pixel_S);
    }
  }
  return matches;
}

std::optional<vision::EpipolarBand> NewPoints::band_of(const StereoView& view,
                                                       const Eigen::Vector2d& pixel_S) const {
  vision::EpipolarOptions band;
  band.n_sigmas = options_.band_sigmas;
  band.sigma_pixel_S = view.rig.sigma_pixel_S;
  band.sigma_pixel_F = view.rig.sigma_pixel_F;
  band.max_half_width = options_.max_band_radius;
  const auto range = vision::InverseDistanceRange::between(std::min(view.near, 0.5 * view.overlap.far_depth),
                                                           view.overlap.far_depth);
  return vision::EpipolarBand::predict(view.rig.camera_S, view.rig.camera_F, view.rig.T_SF, pixel_S, range,
                                       band);
}

vision::PatchMatch NewPoints::search_band(const StereoView& view, const GrayImage& image_S,
                                          const Eigen::Vector2d& pixel_S, const vision::EpipolarBand& band) {
  const vision::ReferencePatch patch = vision::cut_reference(image_S, pixel_S);
  const vision::View slam{view.rig.camera_S, Pose{}};
  const vision::View wearer{view.rig.camera_F, view.rig.T_SF.T};
  const Eigen::Vector3d ray_S = view.rig.camera_S.unproject(pixel_S).value_or(Eigen::Vector3d::UnitZ());
  normals_S_ = vision::surfaces_along(ray_S, view.up_S);
  // Most surfaces do face the camera well enough; the others cost three more searches.
  constexpr double kGoodEnough = 0.93;
  const std::span<const Eigen::Vector3d> all(normals_S_);
  const auto facing = band_search_.find(pyramid_F_, {patch, slam, slam, wearer, pixel_S, all.first(1)}, band);
  if (facing && facing.score > kGoodEnough) return facing;
  return band_search_.find(pyramid_F_, {patch, slam, slam, wearer, pixel_S, all}, band);
}

std::vector<Guess> NewPoints::guesses(const StereoView& view, const GrayImage& image_S,
                                      const std::vector<Eigen::Vector2d>& occupied, int tries) {
  std::vector<Guess> guesses;
  for (const vision::Corner& corner : corners_to_try(view, image_S, occupied, tries)) {
    const auto band = band_of(view, corner.pixel);
    const auto found = band ? search_band(view, image_S, corner.pixel, *band) : vision::PatchMatch{};
    const bool is_ambiguous = found.outcome == vision::SearchOutcome::kAmbiguous;
    if (found || is_ambiguous) {
      guesses.push_back(
          {{{corner.pixel, found.pixel}, normals_S_[band_search_.best_normal()]}, is_ambiguous});
    } else {
      refusals_.push_back({corner.pixel, kRest});
    }
  }
  return guesses;
}

std::vector<NewPoint> NewPoints::judge(const StereoView& view, const std::vector<Guess>& guesses, int wanted,
                                       PseudoStereoCounts& counts) const {
  std::vector<NewPoint> points;
  for (const Guess& guess : guesses) {
    ++counts.described;
    if (guess.is_ambiguous) {
      ++counts.ratio_test;
    } else if (static_cast<int>(points.size()) == wanted) {
      ++counts.redundant;
    } else if (accept(view, guess.point.match, counts)) {
      points.push_back(guess.point);
    }
  }
  return points;
}

std::optional<NewPoint> NewPoints::match_corner(const StereoView& view, const GrayImage& image_S,
                                                const Eigen::Vector2d& pixel_S, PseudoStereoCounts& counts) {
  ++counts.described;
  const auto band = band_of(view, pixel_S);
  if (!band) {
    ++counts.epipolar;
    return std::nullopt;
  }
  const auto found = search_band(view, image_S, pixel_S, *band);
  if (!found) {
    ++counts.ratio_test;
    return std::nullopt;
  }
  const ekf::StereoMatch match{pixel_S, found.pixel};
  if (!accept(view, match, counts)) return std::nullopt;
  return NewPoint{match, normals_S_[band_search_.best_normal()]};
}

std::optional<ekf::StereoMatch> NewPoints::refine(const StereoView& view, const GrayImage& image_S,
                                                  const ekf::StereoMatch& rough, PseudoStereoCounts& counts) {
  const ekf::StereoRig& rig = view.rig;
  const auto point = ekf::triangulate(rough, rig.camera_S, rig.camera_F, rig.T_SF.T);
  if (!point) {
    ++counts.too_little_parallax;
    return std::nullopt;
  }
  // A descriptor tells the place to a pixel or two only.
  const auto A = vision::predicted_warp({rig.camera_S, Pose{}}, {rig.camera_F, rig.T_SF.T}, point->p_S);
  const auto patch =
      A ? vision::warp_pyramid(vision::cut_reference(image_S, rough.pixel_S), *A, kPatchSide) : std::nullopt;
  constexpr double kDescriptorSigma = 1.0;  // [px]
  const Eigen::Matrix2d S = kDescriptorSigma * kDescriptorSigma * Eigen::Matrix2d::Identity();
  const auto found = patch ? refinement_.find(*view.image_F, *patch, rough.pixel_F, S) : vision::PatchMatch{};
  if (!found) {
    ++counts.ratio_test;
    return std::nullopt;
  }
  const ekf::StereoMatch match{rough.pixel_S, found.pixel};
  return accept(view, match, counts) ? std::optional(match) : std::nullopt;
}

bool NewPoints::accept(const StereoView& view, const ekf::StereoMatch& match,
                       PseudoStereoCounts& counts) const {
  const auto point = ekf::triangulate(match, view.rig.camera_S, view.rig.camera_F, view.rig.T_SF.T);
  if (point && has_depth(*point, view.rig, options_)) return true;
  ++counts.too_little_parallax;
  return false;
}

}  // namespace cosight::slam
