#include "robot_agent/vision/descriptor_matcher.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace cosight::vision {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double distance(const DescribedFeatures& a, std::size_t i, const DescribedFeatures& b, std::size_t k) {
  if (!a.is_binary()) {
    return static_cast<double>(
        (a.vectors.row(static_cast<Eigen::Index>(i)) - b.vectors.row(static_cast<Eigen::Index>(k))).norm());
  }
  int bits = 0;
  for (std::size_t word = 0; word < a.bits[i].size(); ++word) {
    bits += std::popcount(a.bits[i][word] ^ b.bits[k][word]);
  }
  return bits;
}

struct Nearest {
  std::size_t index = 0;
  double best = kNone;
  double second = kNone;

  void offer(std::size_t candidate, double candidate_distance) {
    if (candidate_distance < best) {
      second = best;
      best = candidate_distance;
      index = candidate;
    } else if (candidate_distance < second) {
      second = candidate_distance;
    }
  }
};

}  // namespace

DescriptorMatches match_descriptors(const DescribedFeatures& features_S, const DescribedFeatures& features_F,
                                    const MatcherOptions& options, const MayMatch& may_match) {
  std::vector<Nearest> nearest_of_S(features_S.size());
  std::vector<Nearest> nearest_of_F(features_F.size());
  for (std::size_t i = 0; i < features_S.size(); ++i) {
    for (std::size_t k = 0; k < features_F.size(); ++k) {
      if (may_match && !may_match(i, k)) continue;
      const double d = distance(features_S, i, features_F, k);
      nearest_of_S[i].offer(k, d);
      nearest_of_F[k].offer(i, d);
    }
  }
  const double max_distance = features_S.is_binary() ? options.max_bit_distance : options.max_vector_distance;
  DescriptorMatches result;
  for (std::size_t i = 0; i < nearest_of_S.size(); ++i) {
    const Nearest& nearest = nearest_of_S[i];
    if (nearest.best == kNone) {
      ++result.counts.no_partner;
    } else if (nearest.best > max_distance) {
      ++result.counts.too_far;
    } else if (nearest.best > options.max_ratio * nearest.second) {
      ++result.counts.ambiguous;
    } else if (options.cross_check && nearest_of_F[nearest.index].index != i) {
      ++result.counts.not_mutual;
    } else {
      ++result.counts.matched;
      result.matches.push_back({i, nearest.index, nearest.best});
    }
  }
  return result;
}

}  // namespace cosight::vision
