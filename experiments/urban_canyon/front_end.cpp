#include "experiments/urban_canyon/front_end.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "experiments/urban_canyon/gaussian.hpp"

namespace cosight::experiments {
namespace {

using Eigen::Vector2d;

Vector2d in_plane(const Vector2d& uv) {
  return (uv - 0.5 * Vector2d(CityView::kWidth, CityView::kHeight)) / CityView::kFocalLength;
}

/// Where features already are: no new one so close.
class Taken {
 public:
  explicit Taken(double distance) : distance_(distance) {}

  bool is_free(const Vector2d& uv) const {
    return std::none_of(places_.begin(), places_.end(), [&](const Vector2d& other) {
      return (other - uv).squaredNorm() < distance_ * distance_;
    });
  }
  void add(const Vector2d& uv) { places_.push_back(uv); }

 private:
  double distance_;
  std::vector<Vector2d> places_;
};

}  // namespace

bool FrontEnd::happens(double probability) {
  return std::uniform_real_distribution<double>()(random_) < probability;
}

bool FrontEnd::keeps(Track& track, const Vector2d& uv) {
  constexpr double kSlip = 4.0;  // [px]
  if (happens(options_.loss * track.poorness)) return false;
  if (happens(options_.slip * track.poorness)) track.drift += gaussian<2>(random_, kSlip);
  track.before = track.seen;
  track.seen = uv + track.drift + gaussian<2>(random_, track.noise);
  return true;
}

void FrontEnd::follow(const CityView& view) {
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    const std::optional<Vector2d> uv = view.see(track->first);
    track = uv && keeps(track->second, *uv) ? std::next(track) : tracks_.erase(track);
  }
  reject_outliers();
}

void FrontEnd::reject_outliers() {
  constexpr std::size_t kFewest = 8;
  if (tracks_.size() < kFewest) return;
  std::vector<cv::Point2d> before;
  std::vector<cv::Point2d> now;
  for (const auto& [city_point, track] : tracks_) {
    before.emplace_back(track.before.x(), track.before.y());
    now.emplace_back(track.seen.x(), track.seen.y());
  }
  std::vector<unsigned char> fits;
  cv::findFundamentalMat(before, now, cv::FM_RANSAC, options_.ransac_threshold, options_.ransac_confidence,
                         fits);
  if (fits.size() != tracks_.size()) return;
  std::size_t i = 0;
  std::erase_if(tracks_, [&](const auto&) { return fits[i++] == 0; });
}

void FrontEnd::choose_new(const CityView& view) {
  Taken taken(options_.min_distance);
  for (const auto& [city_point, track] : tracks_)
    taken.add(track.seen);
  std::vector<CityPoint> candidates = view.in_reach();
  std::shuffle(candidates.begin(), candidates.end(), random_);
  for (const CityPoint& candidate : candidates) {
    if (tracks_.size() >= static_cast<std::size_t>(options_.features)) return;
    if (tracks_.contains(candidate)) continue;
    const std::optional<Vector2d> uv = view.see(candidate);
    if (!uv || !taken.is_free(*uv)) continue;
    Track track{.id = next_id_++};
    track.poorness = std::exp(std::log(options_.noise_spread) * gaussian<2>(random_, 1.0).x());
    track.noise = options_.noise * track.poorness;
    track.seen = *uv + gaussian<2>(random_, track.noise);
    taken.add(track.seen);
    tracks_.emplace(candidate, track);
  }
}

std::vector<vins::TrackedFeature> FrontEnd::look(const CityView& view) {
  follow(view);
  choose_new(view);
  std::vector<vins::TrackedFeature> features;
  for (const auto& [city_point, track] : tracks_) {
    features.push_back({track.id, {in_plane(track.seen)}});
    sightings_ += 1.0;
    if (!city_point.moves()) continue;
    moving_sightings_ += 1.0;
    moving_.insert(track.id);
  }
  return features;
}

double FrontEnd::moving_percent() const {
  return 100.0 * moving_sightings_ / std::max(sightings_, 1.0);
}

}  // namespace cosight::experiments
