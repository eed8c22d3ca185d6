#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/wearer/body_sighting.hpp"
#include "robot_agent/wearer/options.hpp"

namespace cosight::wearer {

/// One body on its way: a Kalman filter of [p (m), v (m/s)] in O, speed constant but for white acceleration.
struct PersonTrack {
  using State = Eigen::Vector4d;
  using Covariance = Eigen::Matrix4d;

  std::uint64_t id = 0;
  State x = State::Zero();
  Covariance P = Covariance::Zero();
  Stamp born = 0;
  Stamp seen = 0;
  Eigen::Vector2d born_at = Eigen::Vector2d::Zero();
  int sightings = 0;

  Eigen::Vector2d p_O() const { return x.head<2>(); }
  Eigen::Matrix2d position_covariance() const { return P.topLeftCorner<2, 2>(); }
  double worst_sigma() const;  ///< of the position [m]
  bool has_moved() const;      ///< no furniture

  ///   F = [1 dt; 0 1],   Q = q^2 [dt^3/3 dt^2/2; dt^2/2 dt]
  void predict(double dt, double acceleration);
  /// With `doubt` times the covariance of the sighting.
  void update(const BodySighting& body, double doubt);
};

/// What one scan was to one track.
struct Assignment {
  std::size_t track = 0;
  std::size_t body = 0;
};

/// Which sighting is whose: the most probable pairs first (global nearest neighbour), no limb twice. A body
/// of n limbs explains n returns that would have to be clutter otherwise:
///
///   d^2 + ln |2 pi S| + surprise + 2 n ln(clutter),   only where d^2 < gate.
std::vector<Assignment> assign(std::span<const PersonTrack> tracks, std::span<const BodySighting> bodies,
                               const TrackOptions& options);

/// All people in sight, and what looks like people; each knows only itself, the assignment keeps them apart.
class PersonTracks {
 public:
  explicit PersonTracks(const TrackOptions& options) : options_(options) {}

  void predict(Stamp stamp, double acceleration);

  /// Gives each its sighting, begins new ones with what nobody claims, ends those that are long unseen. The
  /// track `keep` stays however long it is unseen.
  void update(Stamp stamp, std::span<const BodySighting> bodies, std::optional<std::uint64_t> keep);

  std::span<const PersonTrack> all() const { return tracks_; }
  const PersonTrack* find(std::uint64_t id) const;
  /// What the last scan showed of a track, nothing when it was not in it.
  std::optional<BodyPart> seen_part(std::uint64_t id) const;

 private:
  bool crowded(const PersonTrack& track) const;
  void begin(Stamp stamp, std::span<const BodySighting> bodies, std::vector<bool>& claimed);
  void end(Stamp stamp, std::optional<std::uint64_t> keep);

  TrackOptions options_;
  std::vector<PersonTrack> tracks_;
  std::vector<std::pair<std::uint64_t, BodyPart>> parts_;
  std::uint64_t next_id_ = 1;
  std::optional<Stamp> stamp_;
};

}  // namespace cosight::wearer
