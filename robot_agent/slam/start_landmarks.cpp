#include "robot_agent/slam/start_landmarks.hpp"

#include <optional>
#include <utility>

namespace cosight::slam {
namespace {

std::vector<std::optional<ekf::LandmarkId>> add_to(ekf::Filter& filter, const std::vector<NewPoint>& points,
                                                   const ekf::StereoRig& rig, bool correlated) {
  std::vector<ekf::StereoMatch> matches;
  matches.reserve(points.size());
  for (const NewPoint& point : points)
    matches.push_back(point.match);
  if (correlated) return filter.add_pseudo_stereo_landmarks(matches, rig);
  std::vector<std::optional<ekf::LandmarkId>> ids;
  ids.reserve(matches.size());
  for (const ekf::StereoMatch& match : matches)
    ids.push_back(filter.add_pseudo_stereo_landmark(match, rig));
  return ids;
}

}  // namespace

int start_landmarks(const std::vector<NewPoint>& points, const ekf::StereoRig& rig, const GrayImage& image_S,
                    bool correlated, ekf::Filter& filter, LandmarkTracks& tracks,
                    PseudoStereoCounts& counts) {
  const auto ids = add_to(filter, points, rig, correlated);
  int added = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!ids[i]) {
      ++(filter.has_room() ? counts.too_little_parallax : counts.redundant);
      continue;
    }
    const ekf::CameraState camera = filter.camera();
    LandmarkTrack track = track_from(image_S, *ids[i], points[i].match.pixel_S, camera.T_WS());
    if (points[i].normal_S) track.normal_W = camera.q_WS * *points[i].normal_S;
    tracks.add(std::move(track));
    ++added;
  }
  counts.initialised += added;
  return added;
}

}  // namespace cosight::slam
