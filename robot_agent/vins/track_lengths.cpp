#include "robot_agent/vins/track_lengths.hpp"

#include <utility>

namespace cosight::vins {

void TrackLengths::add(const FeatureFrame& frame) {
  std::map<FeatureId, int> before = std::exchange(followed_, {});
  for (const TrackedFeature& feature : frame.features) {
    const auto known = before.extract(feature.id);
    followed_[feature.id] = known ? known.mapped() + 1 : 1;
  }
  sightings_ += frame.features.size();
  for (const auto& [id, times] : before)
    if (times < kInlierTracks) outlier_sightings_ += static_cast<std::uint64_t>(times);
}

}  // namespace cosight::vins
