#include "robot_agent/vision/descriptor_matcher.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace cosight::vision {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

double vector_distance(const DescribedFeatures& a, std::size_t i, const DescribedFeatures& b, std::size_t k) {
  return static_cast<double>(
      (a.vectors.row(static_cast<Eigen::Index>(i)) - b.vectors.row(static_cast<Eigen::Index>(k))).norm());
}

/// Bits that differ between `a` and each of `others`.
using CountBits = void (*)(const BitDescriptor& a, const std::vector<BitDescriptor>& others,
                           std::vector<int>& out);

[[gnu::always_inline]] inline void count_each(const BitDescriptor& a,
                                              const std::vector<BitDescriptor>& others,
                                              std::vector<int>& out) {
  for (std::size_t k = 0; k < others.size(); ++k) {
    int bits = 0;
    for (std::size_t word = 0; word < a.size(); ++word)
      bits += std::popcount(a[word] ^ others[k][word]);
    out[k] = bits;
  }
}

void count_bits_portable(const BitDescriptor& a, const std::vector<BitDescriptor>& others,
                         std::vector<int>& out) {
  count_each(a, others, out);
}

#if defined(__x86_64__)
/// One instruction a word instead of a table.
__attribute__((target("popcnt"))) void count_bits_popcnt(const BitDescriptor& a,
                                                         const std::vector<BitDescriptor>& others,
                                                         std::vector<int>& out) {
  count_each(a, others, out);
}
#endif

CountBits fastest_count_bits() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("popcnt")) return count_bits_popcnt;
#endif
  return count_bits_portable;
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

/// Bits are compared faster than the geometry is asked, so it is asked only where the answer matters.
void find_nearest_bits(const DescribedFeatures& features_S, const DescribedFeatures& features_F,
                       const MayMatch& may_match, std::vector<Nearest>& nearest_of_S) {
  const CountBits count_bits = fastest_count_bits();
  std::vector<int> bits(features_F.size());
  for (std::size_t i = 0; i < features_S.size(); ++i) {
    count_bits(features_S.bits[i], features_F.bits, bits);
    for (std::size_t k = 0; k < features_F.size(); ++k) {
      if (bits[k] < nearest_of_S[i].second && (!may_match || may_match(i, k)))
        nearest_of_S[i].offer(k, bits[k]);
    }
  }
}

void find_nearest_vectors(const DescribedFeatures& features_S, const DescribedFeatures& features_F,
                          const MayMatch& may_match, std::vector<Nearest>& nearest_of_S) {
  for (std::size_t i = 0; i < features_S.size(); ++i) {
    for (std::size_t k = 0; k < features_F.size(); ++k) {
      if (!may_match || may_match(i, k))
        nearest_of_S[i].offer(k, vector_distance(features_S, i, features_F, k));
    }
  }
}

/// Whether no other feature of S that may match `match.index_F` is nearer to it; of equals the first wins.
bool is_mutual(const DescriptorMatch& match, const DescribedFeatures& features_S,
               const DescribedFeatures& features_F, const MayMatch& may_match) {
  const std::size_t k = match.index_F;
  std::vector<int> bits(features_S.bits.size());
  if (features_S.is_binary()) fastest_count_bits()(features_F.bits[k], features_S.bits, bits);
  for (std::size_t i = 0; i < features_S.size(); ++i) {
    const double d = features_S.is_binary() ? bits[i] : vector_distance(features_S, i, features_F, k);
    const bool is_nearer = d < match.distance || (d == match.distance && i < match.index_S);
    if (is_nearer && (!may_match || may_match(i, k))) return false;
  }
  return true;
}

}  // namespace

DescriptorMatches match_descriptors(const DescribedFeatures& features_S, const DescribedFeatures& features_F,
                                    const MatcherOptions& options, const MayMatch& may_match) {
  std::vector<Nearest> nearest_of_S(features_S.size());
  const bool is_binary = features_S.is_binary();
  (is_binary ? find_nearest_bits : find_nearest_vectors)(features_S, features_F, may_match, nearest_of_S);
  const double max_distance = is_binary ? options.max_bit_distance : options.max_vector_distance;
  DescriptorMatches result;
  for (std::size_t i = 0; i < nearest_of_S.size(); ++i) {
    const Nearest& nearest = nearest_of_S[i];
    const DescriptorMatch match{i, nearest.index, nearest.best};
    if (nearest.best == kNone) {
      ++result.counts.no_partner;
    } else if (nearest.best > max_distance) {
      ++result.counts.too_far;
    } else if (nearest.best > options.max_ratio * nearest.second) {
      ++result.counts.ambiguous;
    } else if (options.cross_check && !is_mutual(match, features_S, features_F, may_match)) {
      ++result.counts.not_mutual;
    } else {
      ++result.counts.matched;
      result.matches.push_back(match);
    }
  }
  return result;
}

}  // namespace cosight::vision
