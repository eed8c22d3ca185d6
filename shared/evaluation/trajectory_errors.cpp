#include "shared/evaluation/trajectory_errors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

using IndexPairs = std::vector<std::pair<std::size_t, std::size_t>>;

IndexPairs frame_intervals(std::size_t count, std::size_t delta, bool all_pairs) {
  IndexPairs intervals;
  const std::size_t step = all_pairs ? 1 : delta;
  for (std::size_t i = 0; i + delta < count; i += step)
    intervals.emplace_back(i, i + delta);
  return intervals;
}

/// Intervals whose length, the sum of `length(i)` of the steps to i, first reaches `delta`.
template <typename Length>
IndexPairs long_enough_intervals(std::size_t count, double delta, Length length) {
  constexpr double kRounding = 1e-9;
  IndexPairs intervals;
  double travelled = 0.0;
  std::size_t start = 0;
  for (std::size_t i = 1; i < count; ++i) {
    travelled += length(i);
    if (travelled + kRounding < delta) continue;
    intervals.emplace_back(start, i);
    start = i;
    travelled = 0.0;
  }
  return intervals;
}

IndexPairs intervals_of(const std::vector<PosePair>& pairs, const RelativeErrorOptions& options) {
  switch (options.unit) {
    case DeltaUnit::kFrames: {
      const double frames = std::max(1.0, std::round(options.delta));
      return frame_intervals(pairs.size(), static_cast<std::size_t>(frames), options.all_pairs);
    }
    case DeltaUnit::kMetres:
      return long_enough_intervals(pairs.size(), options.delta, [&](std::size_t i) {
        return (pairs[i].T_WC_truth.p - pairs[i - 1].T_WC_truth.p).norm();
      });
    case DeltaUnit::kSeconds:
      return long_enough_intervals(pairs.size(), options.delta, [&](std::size_t i) {
        return to_seconds(pairs[i].stamp - pairs[i - 1].stamp);
      });
  }
  return {};
}

double angle(const Eigen::Quaterniond& q) {
  return quaternion_log(q).norm();
}

template <typename Position>
double length_of(const std::vector<PosePair>& pairs, Position position) {
  double length = 0.0;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    length += (position(pairs[i]) - position(pairs[i - 1])).norm();
  return length;
}

}  // namespace

std::vector<PosePair> aligned(std::vector<PosePair> pairs, const Similarity& similarity) {
  for (PosePair& pair : pairs)
    pair.T_WC_estimate = similarity * pair.T_WC_estimate;
  return pairs;
}

std::vector<double> position_errors(const std::vector<PosePair>& pairs) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const PosePair& pair : pairs)
    errors.push_back((pair.T_WC_truth.p - pair.T_WC_estimate.p).norm());
  return errors;
}

std::vector<double> rotation_errors(const std::vector<PosePair>& pairs) {
  std::vector<double> errors;
  errors.reserve(pairs.size());
  for (const PosePair& pair : pairs)
    errors.push_back(angle(pair.T_WC_truth.q.conjugate() * pair.T_WC_estimate.q));
  return errors;
}

double true_path_length(const std::vector<PosePair>& pairs) {
  return length_of(pairs, [](const PosePair& pair) { return pair.T_WC_truth.p; });
}

double estimated_path_length(const std::vector<PosePair>& pairs) {
  return length_of(pairs, [](const PosePair& pair) { return pair.T_WC_estimate.p; });
}

std::optional<DeltaUnit> delta_unit_from(const std::string& name) {
  if (name == "frames") return DeltaUnit::kFrames;
  if (name == "metres") return DeltaUnit::kMetres;
  if (name == "seconds") return DeltaUnit::kSeconds;
  return std::nullopt;
}

RelativeErrors relative_errors(const std::vector<PosePair>& pairs, const RelativeErrorOptions& options) {
  RelativeErrors errors;
  for (const auto& [i, j] : intervals_of(pairs, options)) {
    const Pose Q_ij = pairs[i].T_WC_truth.inverse() * pairs[j].T_WC_truth;
    const Pose P_ij = pairs[i].T_WC_estimate.inverse() * pairs[j].T_WC_estimate;
    const Pose E_ij = Q_ij.inverse() * P_ij;
    errors.translation.push_back(E_ij.p.norm());
    errors.rotation.push_back(angle(E_ij.q));
  }
  return errors;
}

}  // namespace cosight
