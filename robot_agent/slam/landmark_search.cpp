#include "robot_agent/slam/landmark_search.hpp"

#include <algorithm>
#include <cmath>

#include "robot_agent/ekf/chi_squared.hpp"
#include "robot_agent/vision/patch_warp.hpp"

namespace cosight::slam {
namespace {

constexpr int kPatchSide = 13;
constexpr double kImageMargin = 8.0;  ///< a patch must lie inside the image [px]

vision::SearchOptions vision_options(const SearchOptions& options) {
  vision::SearchOptions result;
  result.n_sigmas = std::sqrt(ekf::chi_squared_quantile(options.gate_probability, 2));
  result.max_half_window = options.max_radius;
  result.min_score = options.min_correlation;
  result.max_second_ratio = options.max_ambiguity;
  return result;
}

}  // namespace

Eigen::Vector3d finite_point(const ekf::LandmarkEstimate& landmark) {
  constexpr double kMinInverseDepth = 1e-3;
  if (!landmark.is_inverse_depth || landmark.y.rho > kMinInverseDepth) return landmark.p_W;
  return landmark.y.anchor_W + landmark.y.ray_W() / kMinInverseDepth;
}

LandmarkSearch::LandmarkSearch(const SearchOptions& options)
    : options_(options), search_(vision_options(options)) {}

const std::vector<ekf::PixelPrediction>& LandmarkSearch::predict(const ekf::Filter& filter,
                                                                 const LandmarkTracks& tracks) {
  predictions_.clear();
  for (const LandmarkTrack& track : tracks.all()) {
    const auto prediction = filter.predict_pixel(track.id);
    if (prediction && filter.camera_model().contains(prediction->pixel, kImageMargin)) {
      predictions_.push_back(*prediction);
    }
  }
  std::stable_sort(predictions_.begin(), predictions_.end(),
                   [](const auto& a, const auto& b) { return a.S.trace() > b.S.trace(); });
  return predictions_;
}

std::vector<Sighting> LandmarkSearch::find(const GrayImage& image, const ekf::Filter& filter,
                                           LandmarkTracks& tracks, bool known_motion,
                                           const ConvexPolygon& hidden, SearchCounts& counts) {
  std::vector<Sighting> sightings;
  std::vector<LandmarkTrack*> missed;
  counts.predicted_in_view = static_cast<int>(predictions_.size());
  MeasurementBudget budget(options_.budget, filter.state().size(), search_.options().n_sigmas,
                           options_.max_radius);
  for (const ekf::PixelPrediction& prediction : predictions_) {
    if (counts.searched == options_.max_measured) break;
    if (contains(hidden, prediction.pixel)) continue;
    constexpr double kKnownMotionSigma = 2.5;  // what the found motion leaves unexplained [px]
    const Eigen::Matrix2d S =
        known_motion ? Eigen::Matrix2d(kKnownMotionSigma * kKnownMotionSigma * Eigen::Matrix2d::Identity())
                     : prediction.S;
    if (!budget.admit(S)) continue;
    LandmarkTrack& track = *tracks.find(prediction.landmark);
    const auto patch = predicted_patch(filter, track);
    ++counts.searched;
    const auto match = patch ? search_.find(image, *patch, prediction.pixel, S) : vision::PatchMatch{};
    if (!match) {
      ++counts.not_found;
      missed.push_back(&track);
      continue;
    }
    ++track.attempts;
    sightings.push_back({track.id, match.pixel});
  }
  // An image that shows none of them, such as one of a covered lens, says nothing of any one of them.
  if (sightings.empty()) return sightings;
  for (LandmarkTrack* track : missed) {
    ++track->attempts;
    ++track->failures;
  }
  return sightings;
}

std::optional<vision::PatchPyramid> LandmarkSearch::predicted_patch(const ekf::Filter& filter,
                                                                    const LandmarkTrack& track) const {
  const auto landmark = filter.landmark(track.id);
  if (!landmark) return std::nullopt;
  const vision::View reference{filter.camera_model(), track.T_WS_reference};
  const vision::View present{filter.camera_model(), filter.camera().T_WS()};
  const Eigen::Vector3d p_W = finite_point(*landmark);
  const auto A = track.normal_W ? vision::predicted_warp(reference, present, p_W, *track.normal_W)
                                : vision::predicted_warp(reference, present, p_W);
  return vision::warp_pyramid(track.reference, A.value_or(Eigen::Matrix2d::Identity()), kPatchSide);
}

}  // namespace cosight::slam
