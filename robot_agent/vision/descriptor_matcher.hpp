#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "robot_agent/vision/descriptor.hpp"

namespace cosight::vision {

struct MatcherOptions {
  double max_ratio = 0.8;   ///< best over second best distance; lower for repeated texture
  bool cross_check = true;  ///< the best partner's best partner must be the feature itself
  double max_bit_distance =
      64.0;  ///< of 256 bits (ORB); guards where a feature has only one partner to choose
  double max_vector_distance = 0.6;  ///< between unit vectors (SIFT, SURF), likewise
};

struct DescriptorMatch {
  std::size_t index_S = 0;
  std::size_t index_F = 0;
  double distance = 0.0;
};

/// Every feature of S is in exactly one of these.
struct MatchCounts {
  int no_partner = 0;  ///< the geometry left none to compare with
  int too_far = 0;     ///< the best is not alike
  int ambiguous = 0;   ///< ratio test
  int not_mutual = 0;  ///< cross check
  int matched = 0;
};

struct DescriptorMatches {
  std::vector<DescriptorMatch> matches;  ///< in the order of index_S
  MatchCounts counts;
};

/// Whether feature `index_S` may be the same thing as `index_F`, by geometry alone. Descriptors then compete
/// only among those that may, which lets more pass the ratio test.
using MayMatch = std::function<bool(std::size_t index_S, std::size_t index_F)>;

/// Exhaustive comparison of two sets of one kind of descriptor. Without `may_match` all pairs compete.
DescriptorMatches match_descriptors(const DescribedFeatures& features_S, const DescribedFeatures& features_F,
                                    const MatcherOptions& options = {}, const MayMatch& may_match = {});

}  // namespace cosight::vision
