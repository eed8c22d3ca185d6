#include "robot_agent/wearer/person_tracks.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cosight::wearer {
namespace {

constexpr std::size_t kMaxTracks = 40;

/// How probable the pair is, as -2 ln; nothing outside the gate.
std::optional<double> cost(const PersonTrack& track, const BodySighting& body, const TrackOptions& options) {
  const Eigen::Matrix2d S = track.position_covariance() + body.covariance;
  const Eigen::Vector2d innovation = body.p_O - track.p_O();
  const double d2 = innovation.dot(S.llt().solve(innovation));
  if (!(d2 < options.gate)) return std::nullopt;
  constexpr double kTwoPi = 2.0 * std::numbers::pi;
  return d2 + std::log(kTwoPi * kTwoPi * S.determinant()) + body.surprise +
         2.0 * static_cast<double>(body.limbs.size()) * std::log(options.clutter);
}

bool any_claimed(const BodySighting& body, const std::vector<bool>& claimed) {
  return std::any_of(body.limbs.begin(), body.limbs.end(), [&](std::size_t limb) { return claimed[limb]; });
}

void claim(const BodySighting& body, std::vector<bool>& claimed, bool by_somebody) {
  for (const std::size_t limb : body.limbs)
    claimed[limb] = by_somebody;
}

std::vector<bool> nothing_claimed(std::span<const BodySighting> bodies) {
  std::size_t limbs = 0;
  for (const BodySighting& body : bodies) {
    for (const std::size_t limb : body.limbs)
      limbs = std::max(limbs, limb + 1);
  }
  return std::vector<bool>(limbs, false);
}

/// Depth first over the tracks: each takes one of its sightings or none; the least sum of costs wins.
class JointAssignment {
 public:
  JointAssignment(std::span<const PersonTrack> tracks, std::span<const BodySighting> bodies,
                  const TrackOptions& options)
      : bodies_(bodies), claimed_(nothing_claimed(bodies)) {
    for (std::size_t t = 0; t < tracks.size(); ++t) {
      std::vector<Option> ways;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        const auto c = cost(tracks[t], bodies[b], options);
        if (c && *c < kUnseen) ways.push_back({*c - kUnseen, {t, b}});
      }
      if (ways.empty()) continue;
      std::stable_sort(ways.begin(), ways.end(),
                       [](const auto& a, const auto& b) { return a.cost < b.cost; });
      ways_.push_back(std::move(ways));
    }
    // What all tracks from the k-th on can gain at best, were there nobody else.
    at_best_.assign(ways_.size() + 1, 0.0);
    for (std::size_t k = ways_.size(); k-- > 0;)
      at_best_[k] = at_best_[k + 1] + ways_[k].front().cost;
  }

  std::vector<Assignment> best() {
    descend(0, 0.0);
    return best_;
  }

 private:
  struct Option {
    double cost = 0.0;  ///< against not being seen
    Assignment pair;
  };

  static constexpr double kUnseen = 4.6;  // -2 ln of one scan in ten
  static constexpr int kMaxSteps = 20'000;

  void descend(std::size_t k, double cost_so_far) {
    if (cost_so_far + at_best_[k] >= best_cost_ || ++steps_ > kMaxSteps) return;
    if (k == ways_.size()) {
      best_cost_ = cost_so_far;
      best_ = chosen_;
      return;
    }
    for (const Option& way : ways_[k]) {
      const BodySighting& body = bodies_[way.pair.body];
      if (any_claimed(body, claimed_)) continue;
      claim(body, claimed_, true);
      chosen_.push_back(way.pair);
      descend(k + 1, cost_so_far + way.cost);
      chosen_.pop_back();
      claim(body, claimed_, false);
    }
    descend(k + 1, cost_so_far);
  }

  std::span<const BodySighting> bodies_;
  std::vector<std::vector<Option>> ways_;  ///< of each track that has any, the cheapest first
  std::vector<double> at_best_;
  std::vector<bool> claimed_;
  std::vector<Assignment> chosen_;
  std::vector<Assignment> best_;
  double best_cost_ = 1e-9;
  int steps_ = 0;
};

}  // namespace

double PersonTrack::worst_sigma() const {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(position_covariance(), Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(solver.eigenvalues().maxCoeff(), 0.0));
}

bool PersonTrack::has_moved() const {
  constexpr double kStep = 0.25;  // [m]
  return (p_O() - born_at).norm() > kStep + 2.0 * worst_sigma();
}

void PersonTrack::predict(double dt, double acceleration) {
  const double q = acceleration * acceleration;
  Covariance F = Covariance::Identity();
  F.topRightCorner<2, 2>().diagonal().setConstant(dt);
  P = F * P * F.transpose();
  P.topLeftCorner<2, 2>().diagonal().array() += q * dt * dt * dt / 3.0;
  P.topRightCorner<2, 2>().diagonal().array() += q * dt * dt / 2.0;
  P.bottomLeftCorner<2, 2>().diagonal().array() += q * dt * dt / 2.0;
  P.bottomRightCorner<2, 2>().diagonal().array() += q * dt;
  x = F * x;
}

void PersonTrack::update(const BodySighting& body, double doubt) {
  const Eigen::Matrix2d S = position_covariance() + doubt * body.correlation * body.covariance;
  const Eigen::Matrix<double, 4, 2> K = P.leftCols<2>() * S.inverse();
  x += K * (body.p_O - p_O());
  P -= K * S * K.transpose();
  P = 0.5 * (P + P.transpose()).eval();
  ++sightings;
}

std::vector<Assignment> assign(std::span<const PersonTrack> tracks, std::span<const BodySighting> bodies,
                               const TrackOptions& options) {
  return JointAssignment(tracks, bodies, options).best();
}

void PersonTracks::predict(Stamp stamp, double acceleration) {
  const double dt = stamp_ ? std::max(0.0, to_seconds(stamp - *stamp_)) : 0.0;
  for (PersonTrack& track : tracks_)
    track.predict(dt, acceleration);
  stamp_ = stamp;
}

void PersonTracks::update(Stamp stamp, std::span<const BodySighting> bodies,
                          std::optional<std::uint64_t> keep) {
  constexpr double kCrowd = 5.0;  // a leg may be somebody else's
  std::vector<bool> claimed = nothing_claimed(bodies);
  parts_.clear();
  for (const Assignment& pair : assign(tracks_, bodies, options_)) {
    PersonTrack& track = tracks_[pair.track];
    track.update(bodies[pair.body], crowded(track) ? kCrowd : 1.0);
    track.seen = stamp;
    parts_.emplace_back(track.id, bodies[pair.body].part);
    claim(bodies[pair.body], claimed, true);
  }
  begin(stamp, bodies, claimed);
  end(stamp, keep);
}

bool PersonTracks::crowded(const PersonTrack& track) const {
  constexpr double kReach = 0.7;  // of another one's legs [m]
  return std::any_of(tracks_.begin(), tracks_.end(), [&](const PersonTrack& other) {
    return other.id != track.id && other.has_moved() && (other.p_O() - track.p_O()).norm() < kReach;
  });
}

void PersonTracks::begin(Stamp stamp, std::span<const BodySighting> bodies, std::vector<bool>& claimed) {
  constexpr double kNotTwice = 0.4;  // no second body so near to one [m]
  std::vector<const BodySighting*> whole;
  for (const BodySighting& body : bodies) {
    if (body.part != BodyPart::kOneLeg) whole.push_back(&body);
  }
  std::stable_sort(whole.begin(), whole.end(),
                   [](const auto* a, const auto* b) { return a->surprise < b->surprise; });
  for (const BodySighting* body : whole) {
    const bool taken = any_claimed(*body, claimed) ||
                       std::any_of(tracks_.begin(), tracks_.end(), [&](const PersonTrack& track) {
                         return (track.p_O() - body->p_O).norm() < kNotTwice;
                       });
    if (taken || tracks_.size() >= kMaxTracks) continue;
    claim(*body, claimed, true);
    PersonTrack track;
    track.id = next_id_++;
    track.x.head<2>() = body->p_O;
    track.P.topLeftCorner<2, 2>() = body->correlation * body->covariance;
    track.P.bottomRightCorner<2, 2>() =
        options_.start_speed * options_.start_speed * Eigen::Matrix2d::Identity();
    track.born = track.seen = stamp;
    track.born_at = body->p_O;
    tracks_.push_back(track);
  }
}

void PersonTracks::end(Stamp stamp, std::optional<std::uint64_t> keep) {
  std::erase_if(tracks_, [&](const PersonTrack& track) {
    return track.id != keep && to_seconds(stamp - track.seen) > options_.drop_after;
  });
}

const PersonTrack* PersonTracks::find(std::uint64_t id) const {
  const auto found =
      std::find_if(tracks_.begin(), tracks_.end(), [&](const PersonTrack& track) { return track.id == id; });
  return found == tracks_.end() ? nullptr : &*found;
}

std::optional<BodyPart> PersonTracks::seen_part(std::uint64_t id) const {
  for (const auto& [track, part] : parts_) {
    if (track == id) return part;
  }
  return std::nullopt;
}

}  // namespace cosight::wearer
