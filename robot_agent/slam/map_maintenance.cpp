#include "robot_agent/slam/map_maintenance.hpp"

#include <algorithm>

namespace cosight::slam {
namespace {

MapPoint map_point(const LandmarkTrack& track, const ekf::LandmarkEstimate& landmark) {
  MapPoint point;
  point.id = track.id;
  point.p_W = landmark.p_W;
  point.covariance = landmark.p_W_covariance;
  constexpr int kCentre = vision::ReferencePatch::kHalf * (vision::ReferencePatch::kSide + 1);
  point.intensity = track.reference.gray[kCentre];
  point.observations = track.observations;
  return point;
}

}  // namespace

bool MapMaintenance::is_wrong(const LandmarkTrack& track, const ekf::Filter& filter) const {
  const auto landmark = filter.landmark(track.id);
  // Beyond infinity by more than its uncertainty: the depth was never right.
  if (landmark && landmark->is_inverse_depth && landmark->y.rho < -2.0 * landmark->sigma_rho) return true;
  return track.attempts >= options_.min_attempts &&
         track.failures > options_.max_failed_ratio * track.attempts;
}

int MapMaintenance::tidy(ekf::Filter& filter, LandmarkTracks& tracks) {
  std::vector<MapPoint> good;
  std::vector<ekf::LandmarkId> leaving;
  for (LandmarkTrack& track : tracks.all()) {
    track.frames_unseen = track.found ? 0 : track.frames_unseen + 1;
    if (is_wrong(track, filter)) {
      leaving.push_back(track.id);
      archive_.remove(track.id);
      continue;
    }
    if (track.frames_unseen > options_.forget_after_frames) leaving.push_back(track.id);
    if (const auto landmark = filter.landmark(track.id)) {
      MapPoint point = map_point(track, *landmark);
      if (point.p_W.allFinite()) good.push_back(point);
    }
  }
  archive_.update(good);
  for (const ekf::LandmarkId id : leaving) {
    filter.remove_landmark(id);
    tracks.remove(id);
  }
  return static_cast<int>(leaving.size());
}

int MapMaintenance::make_room(ekf::Filter& filter, LandmarkTracks& tracks, int wanted) const {
  const auto unseen_longest = [&] {
    return std::max_element(tracks.all().begin(), tracks.all().end(),
                            [](const auto& a, const auto& b) { return a.frames_unseen < b.frames_unseen; });
  };
  constexpr int kOutOfView = 2;  // frames unseen; one missed frame is no reason
  while (options_.max_landmarks - filter.landmark_count() < wanted) {
    const auto track = unseen_longest();
    if (track == tracks.all().end() || track->frames_unseen < kOutOfView) break;
    filter.remove_landmark(track->id);
    tracks.all().erase(track);
  }
  return std::clamp(options_.max_landmarks - filter.landmark_count(), 0, wanted);
}

}  // namespace cosight::slam
