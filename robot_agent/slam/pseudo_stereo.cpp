#include "robot_agent/slam/pseudo_stereo.hpp"

#include <algorithm>
#include <cmath>

#include "robot_agent/ekf/triangulation.hpp"
#include "robot_agent/vision/patch_warp.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::slam {
namespace {

constexpr int kPatchSide = 13;
/// Where Cf should see a point of S, and how surely.
struct WearerPrediction {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  Eigen::Matrix2d S =
      Eigen::Matrix2d::Identity();  ///< from the point, the pose of Cf and its pixel noise [px^2]
};

/// p_F = R_SF^T (p_S - t); with R_SF = Exp(dtheta) R_hat:  dp_F = R_hat^T (dp_S - dt + [p_S - t]x dtheta).
/// An uncertain depth stretches S along the epipolar line: the ellipse is the epipolar band.
std::optional<WearerPrediction> predict_in_wearer(const ekf::StereoRig& rig,
                                                  const ekf::PointPrediction& point) {
  const Eigen::Matrix3d R_FS = rig.T_SF.T.q.conjugate().toRotationMatrix();
  const Eigen::Vector3d from_F = point.p_S - rig.T_SF.T.p;
  Eigen::Matrix<double, 2, 3> J_pixel;
  const auto pixel = rig.camera_F.project(R_FS * from_F, &J_pixel);
  if (!pixel || !rig.camera_F.contains(*pixel)) return std::nullopt;
  const Eigen::Matrix<double, 2, 3> J_point = J_pixel * R_FS;
  Eigen::Matrix<double, 2, 6> J_pose;
  J_pose << -J_point, J_point * skew(from_F);
  WearerPrediction prediction;
  prediction.pixel = *pixel;
  prediction.S = J_point * point.covariance * J_point.transpose() +
                 J_pose * rig.T_SF.covariance * J_pose.transpose() +
                 rig.sigma_pixel_F * rig.sigma_pixel_F * Eigen::Matrix2d::Identity();
  return prediction;
}

}  // namespace

vision::SearchOptions band_search_options(const PseudoStereoOptions& options) {
  vision::SearchOptions result;
  result.n_sigmas = options.band_sigmas;
  result.min_score = options.min_correlation;
  result.max_half_window = options.max_band_radius;
  result.max_second_ratio = options.max_ambiguity;
  return result;
}

PseudoStereo::PseudoStereo(const PseudoStereoOptions& options, double pixel_sigma)
    : options_(options), pixel_sigma_(pixel_sigma), search_(band_search_options(options)) {}

PseudoStereo::Matches PseudoStereo::match(const StereoView& view, const GrayImage& image_S,
                                          const std::vector<Sighting>& sightings, const ekf::Filter& filter,
                                          LandmarkTracks& tracks, PseudoStereoCounts& counts) {
  Matches matches(sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    if (!contains(view.overlap.roi_in_S, sightings[i].pixel)) continue;
    if (LandmarkTrack* track = tracks.find(sightings[i].landmark))
      matches[i] = match_landmark(view, image_S, sightings[i], filter, *track, counts);
  }
  return matches;
}

std::optional<ekf::StereoMatch> PseudoStereo::match_landmark(const StereoView& view, const GrayImage& image_S,
                                                             const Sighting& sighting,
                                                             const ekf::Filter& filter, LandmarkTrack& track,
                                                             PseudoStereoCounts& counts) {
  ++counts.described;
  const auto p_S = filter.predict_point(sighting.landmark);
  const auto prediction = p_S ? predict_in_wearer(view.rig, *p_S) : std::nullopt;
  if (!prediction) {
    ++counts.epipolar;
    return std::nullopt;
  }
  // Both images are of one moment: the patch comes from the present one, not from the landmark's past.
  const vision::ReferencePatch reference = vision::cut_reference(image_S, sighting.pixel);
  const Eigen::Quaterniond q_WS = filter.camera().q_WS;
  vision::PatchMatch best;
  Eigen::Vector3d best_normal_S = Eigen::Vector3d::Zero();
  const auto try_normal = [&](const Eigen::Vector3d& normal_S) {
    const auto match = search(view, reference, p_S->p_S, normal_S, prediction->pixel, prediction->S);
    if (!match || (best && match.score <= best.score)) return;
    best = match;
    best_normal_S = normal_S;
  };
  if (track.normal_W) try_normal(q_WS.conjugate() * *track.normal_W);
  if (!best) {
    for (const Eigen::Vector3d& normal_S : vision::surfaces_along(p_S->p_S, view.up_S))
      try_normal(normal_S);
  }
  if (!best) {
    ++counts.ratio_test;
    return std::nullopt;
  }
  track.normal_W = q_WS * best_normal_S;
  return ekf::StereoMatch{sighting.pixel, best.pixel};
}

vision::PatchMatch PseudoStereo::search(const StereoView& view, const vision::ReferencePatch& reference,
                                        const Eigen::Vector3d& p_S, const Eigen::Vector3d& normal_S,
                                        const Eigen::Vector2d& predicted, const Eigen::Matrix2d& S) {
  const auto A = vision::predicted_warp({view.rig.camera_S, Pose{}}, {view.rig.camera_F, view.rig.T_SF.T},
                                        p_S, normal_S);
  const auto patch = A ? vision::warp_pyramid(reference, *A, kPatchSide) : std::nullopt;
  return patch ? search_.find(*view.image_F, *patch, predicted, S) : vision::PatchMatch{};
}

std::vector<ekf::Measurement> PseudoStereo::measure(const std::optional<StereoView>& view,
                                                    const std::vector<Sighting>& sightings,
                                                    const Matches& matches,
                                                    PseudoStereoCounts& counts) const {
  std::vector<ekf::Measurement> measurements;
  measurements.reserve(2 * sightings.size());
  for (std::size_t i = 0; i < sightings.size(); ++i) {
    const Sighting& sighting = sightings[i];
    const bool is_worn = view && matches[i];
    const auto point = is_worn && options_.measure_as == WornMeasurement::kPoint
                           ? point_of(*view, *matches[i], counts)
                           : std::nullopt;
    measurements.push_back(point ? ekf::Measurement::point(sighting.landmark, *point)
                                 : ekf::Measurement::pixel(sighting.landmark, sighting.pixel, pixel_sigma_));
    if (is_worn && options_.measure_as == WornMeasurement::kPixel) {
      measurements.push_back(
          ekf::Measurement::wearer_pixel(sighting.landmark, matches[i]->pixel_F, view->rig.sigma_pixel_F));
    }
  }
  return measurements;
}

std::optional<ekf::PointMeasurement> PseudoStereo::point_of(const StereoView& view,
                                                            const ekf::StereoMatch& match,
                                                            PseudoStereoCounts& counts) const {
  const auto point = ekf::triangulate(match, view.rig.camera_S, view.rig.camera_F, view.rig.T_SF.T);
  if (!point || !has_depth(*point, view.rig, options_)) {
    ++counts.too_little_parallax;
    return std::nullopt;
  }
  return ekf::measure_point(match, view.rig);
}

PseudoStereoOutcome outcome_of(const PseudoStereoCounts& counts) {
  if (counts.fused + counts.initialised + counts.redundant > 0) return PseudoStereoOutcome::kMatched;
  if (counts.joint_compatibility > 0) return PseudoStereoOutcome::kJointCompatibility;
  if (counts.chi_squared > 0) return PseudoStereoOutcome::kChiSquared;
  if (counts.too_little_parallax > 0) return PseudoStereoOutcome::kTooLittleParallax;
  if (counts.epipolar > 0) return PseudoStereoOutcome::kEpipolar;
  if (counts.ratio_test > 0) return PseudoStereoOutcome::kRatioTest;
  return PseudoStereoOutcome::kNoFeaturesInRoi;
}

}  // namespace cosight::slam
