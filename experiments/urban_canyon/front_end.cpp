#include "experiments/urban_canyon/front_end.hpp"

#include <algorithm>
#include <cmath>

namespace cosight::experiments {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

Vector2d FrontEnd::gaussian(double sigma) {
  std::normal_distribution<double> draw(0.0, sigma);
  const double u = draw(random_);
  return {u, draw(random_)};
}

/// Distance from the epipolar line that the true motion since the last frame gives. A camera at rest has no
/// such line: then the distance from where the feature was.
bool FrontEnd::is_off_epipolar_line(const CityView& view, const Vector2d& before, const Vector2d& now) const {
  constexpr double kAtRest = 0.02;  // [m]
  const Pose T_now_before = view.T_WS().inverse() * T_WS_before_;
  const Vector3d ray_before = T_now_before.q * in_plane(before).homogeneous();
  const Vector3d ray_now = in_plane(now).homogeneous();
  const double limit = options_.ransac_threshold / CityView::kFocalLength;
  if (T_now_before.p.norm() < kAtRest) return (ray_before.hnormalized() - ray_now.head<2>()).norm() > limit;
  const Vector3d line = T_now_before.p.cross(ray_before);
  return std::abs(line.dot(ray_now)) > limit * line.head<2>().norm();
}

bool FrontEnd::keeps(const CityView& view, Track& track, const Vector2d& uv) {
  constexpr double kSlip = 4.0;  // [px]
  if (happens(options_.loss * track.poorness)) return false;
  track.drift += gaussian(options_.drift * track.poorness);
  if (happens(options_.slip * track.poorness)) track.drift += gaussian(kSlip);
  const Vector2d now = uv + track.drift + gaussian(track.noise);
  if (is_off_epipolar_line(view, track.seen, now)) return false;
  track.seen = now;
  return true;
}

void FrontEnd::follow(const CityView& view) {
  for (auto track = tracks_.begin(); track != tracks_.end();) {
    const std::optional<Vector2d> uv = view.see(track->first);
    const bool kept = uv && keeps(view, track->second, *uv);
    track = kept ? std::next(track) : tracks_.erase(track);
  }
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
    track.poorness = std::exp(std::log(options_.noise_spread) * gaussian(1.0).x());
    track.noise = options_.noise * track.poorness;
    track.seen = *uv + gaussian(track.noise);
    taken.add(track.seen);
    tracks_.emplace(candidate, track);
  }
}

std::vector<vins::TrackedFeature> FrontEnd::look(const CityView& view) {
  follow(view);
  choose_new(view);
  T_WS_before_ = view.T_WS();
  std::vector<vins::TrackedFeature> features;
  for (const auto& [city_point, track] : tracks_) {
    features.push_back({track.id, {in_plane(track.seen), Vector2d::Zero()}});
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
