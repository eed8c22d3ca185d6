#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shared/evaluation/association.hpp"

namespace cosight {

/// How the estimate's world is laid onto the truth's before they are compared.
enum class Alignment {
  kNone,       ///< both in the same world already
  kFirstPose,  ///< the first poses coincide; the drift stays visible
  kSe3,        ///< least squares over the positions, rotation and shift
  kSim3,       ///< the same with scale: for runs that have no metric scale
};

const char* to_string(Alignment alignment);

/// Nothing for a name that is none of none, first_pose, se3, sim3.
std::optional<Alignment> alignment_from(const std::string& name);

/// p_truth = scale R p_estimate + p, where T = (R, p).
struct Similarity {
  double scale = 1.0;
  Pose T;

  Pose operator*(const Pose& T_WC) const {
    return {(T.q * T_WC.q).normalized(), scale * (T.q * T_WC.p) + T.p};
  }
};

/// The similarity that maps the estimate's world to the truth's (Umeyama 1991 for kSe3 and kSim3). Nothing
/// when the positions do not determine it: fewer than three pairs, all on one line (a rotation about it would
/// change nothing), or all in one place.
std::optional<Similarity> align(const std::vector<PosePair>& pairs, Alignment alignment);

/// Scale of the estimate: 1.02 when it is 2 % too large. The inverse of Umeyama's scale, which a straight
/// line determines too. Nothing when either trajectory stays in one place.
std::optional<double> estimated_scale(const std::vector<PosePair>& pairs);

}  // namespace cosight
