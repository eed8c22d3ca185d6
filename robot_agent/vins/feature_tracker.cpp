#include "robot_agent/vins/feature_tracker.hpp"

#include <utility>

#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/point_tracker.hpp"

namespace cosight::vins {

struct FeatureTracker::Tools {
  explicit Tools(const FeatureTrackerOptions& options)
      : tracker({.window = 21, .max_forward_backward = options.max_forward_backward}),
        detector({.min_score = options.min_score, .min_distance = options.min_distance}) {}

  vision::PointTracker tracker;
  vision::CornerDetector detector;
};

FeatureTracker::FeatureTracker(const CameraModel& camera, const FeatureTrackerOptions& options)
    : camera_(camera), options_(options), tools_(std::make_unique<Tools>(options)) {}

FeatureTracker::~FeatureTracker() = default;

FeatureFrame FeatureTracker::track(Stamp stamp, const GrayImage& image) {
  tools_->tracker.advance(image);
  follow();
  replenish(image);
  FeatureFrame frame{stamp, {}};
  for (const Feature& feature : features_)
    frame.features.push_back({feature.id, {feature.point}});
  return frame;
}

void FeatureTracker::follow() {
  std::vector<vision::TrackStart> starts;
  for (const Feature& feature : features_)
    starts.push_back({feature.pixel, feature.pixel, nullptr});
  const std::vector<vision::Track> tracks = tools_->tracker.track(starts);
  std::vector<Feature> kept;
  for (std::size_t i = 0; i < features_.size(); ++i) {
    if (!tracks[i]) continue;
    const auto ray = camera_.unproject(tracks[i].pixel);
    if (!ray) continue;
    kept.push_back({features_[i].id, tracks[i].pixel, ray->head<2>()});
  }
  features_ = std::move(kept);
}

void FeatureTracker::replenish(const GrayImage& image) {
  const int missing = options_.max_features - static_cast<int>(features_.size());
  if (missing <= 0) return;
  std::vector<Eigen::Vector2d> occupied;
  for (const Feature& feature : features_)
    occupied.push_back(feature.pixel);
  for (const vision::Corner& corner : tools_->detector.detect(image, occupied, missing)) {
    const auto ray = camera_.unproject(corner.pixel);
    if (!ray) continue;
    features_.push_back({next_id_++, corner.pixel, ray->head<2>()});
  }
}

}  // namespace cosight::vins
