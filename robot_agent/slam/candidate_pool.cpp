#include "robot_agent/slam/candidate_pool.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "robot_agent/ekf/triangulation.hpp"
#include "robot_agent/vision/patch_warp.hpp"

namespace cosight::slam {
namespace {

constexpr int kPatchSide = 13;
constexpr double kDegree = std::numbers::pi / 180.0;

/// Ray of a pixel in W; nothing when the pixel has none.
std::optional<Eigen::Vector3d> world_ray(const CameraModel& camera, const Pose& T_WS,
                                         const Eigen::Vector2d& pixel) {
  const auto ray_S = camera.unproject(pixel);
  if (!ray_S) return std::nullopt;
  return T_WS.q * ray_S->normalized();
}

}  // namespace

CandidatePool::CandidatePool(const CandidateOptions& options, double pixel_sigma)
    : options_(options), pixel_sigma_(pixel_sigma) {}

void CandidatePool::track(const vision::PointTracker& tracker, const ekf::Filter& filter, double depth,
                          const ConvexPolygon& hidden) {
  const CameraModel& camera = filter.camera_model();
  const Pose T_WS = filter.camera().T_WS();
  std::vector<vision::TrackStart> starts;
  std::vector<vision::Patch> patches(candidates_.size());
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    Candidate& candidate = candidates_[i];
    vision::TrackStart start{candidate.pixel, candidate.pixel, nullptr};
    if (const auto ray = world_ray(camera, candidate.first.T_WS.T, candidate.first.pixel)) {
      const Eigen::Vector3d p_W = candidate.first.T_WS.T.p + depth * *ray;
      if (const auto pixel = camera.project(T_WS.inverse() * p_W); pixel && camera.contains(*pixel)) {
        start.predicted = *pixel;
      }
      const auto A = vision::predicted_warp({camera, candidate.first.T_WS.T}, {camera, T_WS}, p_W);
      if (const auto patch = A ? vision::warp(candidate.reference, *A, kPatchSide) : std::nullopt) {
        patches[i] = *patch;
        start.first = &patches[i];
      }
    }
    starts.push_back(start);
  }
  const std::vector<vision::Track> found = tracker.track(starts);
  std::vector<Candidate> kept;
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    Candidate& candidate = candidates_[i];
    if (!found[i] || contains(hidden, found[i].pixel) || ++candidate.age > options_.max_age_frames) continue;
    candidate.pixel = found[i].pixel;
    kept.push_back(std::move(candidate));
  }
  candidates_ = std::move(kept);
}

bool CandidatePool::has_parallax(const Candidate& candidate, const ekf::Filter& filter) const {
  const Pose T_WS = filter.camera().T_WS();
  const auto clone = candidate.clone ? filter.clone(*candidate.clone) : std::nullopt;
  const Pose first = clone ? clone->T : candidate.first.T_WS.T;
  const Eigen::Vector3d b = T_WS.p - first.p;
  if (b.norm() < options_.min_baseline_m) return false;
  const auto h_1 = world_ray(filter.camera_model(), first, candidate.first.pixel);
  const auto h_2 = world_ray(filter.camera_model(), T_WS, candidate.pixel);
  if (!h_1 || !h_2) return false;
  const auto depth = ekf::inverse_depth_by_sines(*h_2, *h_1, b);
  if (!depth || depth->rho <= 0.0 || depth->parallax < options_.min_parallax_deg * kDegree) return false;
  const double relative_sigma = std::numbers::sqrt2 * pixel_sigma_ /
                                (filter.camera_model().mean_focal_length() * std::tan(depth->parallax));
  return relative_sigma < options_.max_relative_depth_sigma;
}

std::optional<ekf::LandmarkId> CandidatePool::start(const Candidate& candidate, ekf::Filter& filter) const {
  if (candidate.clone)
    return filter.add_delayed_landmark(*candidate.clone, candidate.first.pixel, candidate.pixel);
  return filter.add_delayed_landmark(candidate.first, candidate.pixel);
}

int CandidatePool::initialise(ekf::Filter& filter, LandmarkTracks& tracks, int max_landmarks,
                              int min_distance_px) {
  std::vector<Eigen::Vector2d> occupied = tracks.found_pixels();
  const auto is_free = [&](const Eigen::Vector2d& pixel) {
    return std::none_of(occupied.begin(), occupied.end(),
                        [&](const auto& other) { return (other - pixel).norm() < min_distance_px; });
  };
  int started = 0;
  std::erase_if(candidates_, [&](const Candidate& candidate) {
    if (filter.landmark_count() >= max_landmarks || !filter.has_room()) return false;
    if (!has_parallax(candidate, filter) || !is_free(candidate.pixel)) return false;
    const auto id = start(candidate, filter);
    if (!id) return true;
    LandmarkTrack track;
    track.id = *id;
    track.reference = candidate.reference;
    track.T_WS_reference = candidate.first.T_WS.T;
    track.pixel = candidate.pixel;
    track.found = true;
    tracks.add(std::move(track));
    occupied.push_back(candidate.pixel);
    ++started;
    return true;
  });
  drop_unused_clones(filter);
  return started;
}

void CandidatePool::detect(const GrayImage& image, ekf::Filter& filter,
                           const vision::CornerDetector& detector, std::vector<Eigen::Vector2d> occupied,
                           const ConvexPolygon& hidden, int wanted) {
  if (++frames_since_detection_ < options_.keyframe_interval) return;
  const int missing = std::min(wanted, options_.max_candidates - size());
  if (missing <= 0) return;
  for (const Candidate& candidate : candidates_)
    occupied.push_back(candidate.pixel);
  const auto corners = detector.detect(image, occupied, missing);
  if (corners.empty()) return;
  frames_since_detection_ = 0;
  std::optional<ekf::CloneId> clone;
  if (options_.first_pose == FirstPose::kCloned) {
    clone = filter.clone_camera_pose();
    if (clone) clones_.push_back(*clone);
  }
  const UncertainPose T_WS = filter.T_WS();
  for (const vision::Corner& corner : corners) {
    if (contains(hidden, corner.pixel)) continue;
    candidates_.push_back(
        {{T_WS, corner.pixel}, clone, vision::cut_reference(image, corner.pixel), corner.pixel, 0});
  }
}

void CandidatePool::drop_unused_clones(ekf::Filter& filter) {
  std::erase_if(clones_, [&](ekf::CloneId id) {
    const bool used = std::any_of(candidates_.begin(), candidates_.end(),
                                  [id](const Candidate& candidate) { return candidate.clone == id; });
    if (!used) filter.drop_clone(id);
    return !used;
  });
}

void CandidatePool::clear(ekf::Filter& filter) {
  candidates_.clear();
  drop_unused_clones(filter);
  frames_since_detection_ = options_.keyframe_interval;
}

}  // namespace cosight::slam
