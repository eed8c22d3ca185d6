#include "robot_agent/slam/landmark_tracks.hpp"

#include <algorithm>

namespace cosight::slam {

LandmarkTrack track_from(const GrayImage& image, ekf::LandmarkId id, const Eigen::Vector2d& pixel,
                         const Pose& T_WS) {
  LandmarkTrack track;
  track.id = id;
  track.reference = vision::cut_reference(image, pixel);
  track.T_WS_reference = T_WS;
  track.pixel = pixel;
  track.found = true;
  return track;
}

void LandmarkTracks::remove(ekf::LandmarkId id) {
  std::erase_if(tracks_, [id](const LandmarkTrack& track) { return track.id == id; });
}

LandmarkTrack* LandmarkTracks::find(ekf::LandmarkId id) {
  const auto it = std::find_if(tracks_.begin(), tracks_.end(),
                               [id](const LandmarkTrack& track) { return track.id == id; });
  return it == tracks_.end() ? nullptr : &*it;
}

std::vector<Eigen::Vector2d> LandmarkTracks::found_pixels() const {
  std::vector<Eigen::Vector2d> pixels;
  for (const LandmarkTrack& track : tracks_) {
    if (track.found) pixels.push_back(track.pixel);
  }
  return pixels;
}

}  // namespace cosight::slam
