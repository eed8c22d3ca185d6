#include "shared/evaluation/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/collaboration_metrics.hpp"
#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
constexpr double kMinPath = 1e-6;  // [m]

std::optional<double> percent(double part, double whole) {
  if (whole < kMinPath) return std::nullopt;
  return 100.0 * part / whole;
}

std::vector<PosePair> paired(const Trajectory& estimate, const Trajectory& truth,
                             const EvaluationOptions& options) {
  std::vector<PosePair> pairs = associate(estimate, truth, options.max_difference, options.truth_offset);
  if (!pairs.empty()) return pairs;
  const auto span = [](const Trajectory& trajectory) {
    if (trajectory.empty()) return std::string("nothing");
    return seconds_text(trajectory.front().stamp) + " to " + seconds_text(trajectory.back().stamp) + " s";
  };
  throw EvaluationError("no stamps match within " + seconds_text(options.max_difference) +
                        " s: the estimate covers " + span(estimate) + ", the truth " + span(truth) +
                        "; are they of the same run?");
}

Similarity alignment_of(const std::vector<PosePair>& pairs, Alignment alignment) {
  const std::optional<Similarity> similarity = align(pairs, alignment);
  if (!similarity) {
    throw EvaluationError(
        std::string("the alignment '") + to_string(alignment) +
        "' is not determined: fewer than three poses, or all on one line or in one place; use " +
        "'first_pose' or 'none'");
  }
  return *similarity;
}

void add_statistics(std::vector<Metric>& metrics, const std::string& name, const std::string& unit,
                    const std::vector<double>& errors, double factor = 1.0) {
  const ErrorStatistics statistics = statistics_of(errors);
  const auto value = [&](double error) {
    return errors.empty() ? std::nullopt : std::optional<double>(factor * error);
  };
  metrics.push_back({name + "_" + unit, value(statistics.rmse)});
  metrics.push_back({name + "_mean_" + unit, value(statistics.mean)});
  metrics.push_back({name + "_median_" + unit, value(statistics.median)});
  metrics.push_back({name + "_max_" + unit, value(statistics.max)});
}

/// A run estimates nothing before it has a scale; `coverage_after_start` is the share of what it could have.
void add_extent(std::vector<Metric>& metrics, const Evaluation& evaluation, const Trajectory& estimate,
                const Trajectory& truth, const EvaluationOptions& options) {
  metrics.push_back({"frames", static_cast<double>(estimate.size())});
  metrics.push_back({"compared", static_cast<double>(evaluation.pairs.size())});
  metrics.push_back({"coverage_percent", percent(static_cast<double>(evaluation.pairs.size()),
                                                 static_cast<double>(truth.size()))});
  const Stamp start = evaluation.pairs.front().stamp - options.max_difference;
  const auto after_start = std::count_if(truth.begin(), truth.end(), [&](const StampedPose& pose) {
    return pose.stamp + options.truth_offset >= start;
  });
  metrics.push_back({"coverage_after_start_percent", percent(static_cast<double>(evaluation.pairs.size()),
                                                             static_cast<double>(after_start))});
  metrics.push_back({"path_m", true_path_length(evaluation.pairs)});
}

/// C15 is the sum, C16 the mean of the position errors; V32 the last one as a share of the path.
void add_position_errors(std::vector<Metric>& metrics, const Evaluation& evaluation) {
  const double path = true_path_length(evaluation.pairs);
  const ErrorStatistics statistics = statistics_of(evaluation.position_errors);
  add_statistics(metrics, "ate", "m", evaluation.position_errors);
  add_statistics(metrics, "ate_rotation", "deg", evaluation.rotation_errors, kDegrees);
  metrics.push_back({"final_error_m", evaluation.position_errors.back()});
  metrics.push_back({"final_error_percent", percent(evaluation.position_errors.back(), path)});
  metrics.push_back({"final_rotation_error_deg", kDegrees * evaluation.rotation_errors.back()});
  metrics.push_back({"mean_error_m", statistics.mean});
  metrics.push_back({"mean_error_percent", percent(statistics.mean, path)});
  metrics.push_back({"accumulated_error_m", statistics.mean * static_cast<double>(statistics.count)});
}

void add_relative_errors(std::vector<Metric>& metrics, const Evaluation& evaluation,
                         const RelativeErrorOptions& options) {
  const RelativeErrors errors = relative_errors(evaluation.pairs, options);
  add_statistics(metrics, "rpe", "m", errors.translation);
  add_statistics(metrics, "rpe_rotation", "deg", errors.rotation, kDegrees);
}

/// Of the estimate before alignment: Sim(3) would hide what is asked here.
void add_scale(std::vector<Metric>& metrics, const std::vector<PosePair>& raw_pairs) {
  const std::optional<double> scale = estimated_scale(raw_pairs);
  const double path = true_path_length(raw_pairs);
  const double excess = estimated_path_length(raw_pairs) - path;
  metrics.push_back({"scale", scale});
  metrics.push_back(
      {"scale_error_percent", scale ? std::optional(100.0 * std::abs(*scale - 1.0)) : std::nullopt});
  metrics.push_back({"path_length_error_percent", percent(std::abs(excess), path)});
}

void add_collaboration(std::vector<Metric>& metrics, const Evaluation& evaluation,
                       const std::vector<FrameRecord>& frames) {
  if (frames.empty()) return;
  const OverlapPeriods periods = overlap_periods(frames);
  metrics.push_back({"overlap_ratio", overlap_ratio(periods)});
  metrics.push_back({"overlap_periods", static_cast<double>(periods.overlaps.size())});
  metrics.push_back({"tau", overlap_irregularity(periods)});
  metrics.push_back({"kappa", gap_deviation(periods)});
  metrics.push_back({"u", overlap_cost(periods, evaluation.pairs)});
}

template <typename Value>
std::vector<double> values_of(const std::vector<FrameRecord>& frames, Value value) {
  std::vector<double> values(frames.size());
  std::transform(frames.begin(), frames.end(), values.begin(),
                 [&](const FrameRecord& frame) { return static_cast<double>(value(frame)); });
  return values;
}

void add_frames(std::vector<Metric>& metrics, const std::vector<FrameRecord>& frames) {
  if (frames.empty()) return;
  const std::vector<double> landmarks = values_of(frames, [](const FrameRecord& f) { return f.landmarks; });
  const std::vector<double> times = values_of(frames, [](const FrameRecord& f) { return f.total_ms; });
  const auto share = [&](auto value) { return statistics_of(values_of(frames, value)).mean; };
  metrics.push_back({"landmarks_median", quantile(landmarks, 0.5)});
  metrics.push_back({"pseudo_stereo_share", share([](const FrameRecord& f) { return f.pseudo_stereo; })});
  const auto total = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
  const std::vector<double> worn = values_of(frames, [](const FrameRecord& f) { return f.pseudo_stereo_ms; });
  metrics.push_back({"pseudo_stereo_time_percent", percent(total(worn), total(times))});
  metrics.push_back({"lost_at_end", frames.back().lost ? 1.0 : 0.0});
  metrics.push_back({"lost_share", share([](const FrameRecord& f) { return f.lost; })});
  metrics.push_back({"frame_ms_median", quantile(times, 0.5)});
  metrics.push_back({"frame_ms_p99", quantile(times, 0.99)});
  metrics.push_back({"frame_ms_max", quantile(times, 1.0)});
}

CovarianceLog rotated(const CovarianceLog& covariances, const Eigen::Quaterniond& q) {
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = q.toRotationMatrix();
  turn.bottomRightCorner<3, 3>() = q.toRotationMatrix();
  CovarianceLog result;
  for (const auto& [stamp, P] : covariances)
    result[stamp] = turn * P * turn.transpose();
  return result;
}

void add_consistency(std::vector<Metric>& metrics, const Evaluation& evaluation,
                     const CovarianceLog& covariances) {
  if (covariances.empty()) return;
  const bool metric_scale = evaluation.T_truth_estimate.scale == 1.0;
  std::vector<double> nees;
  if (metric_scale)
    nees = normalised_errors(evaluation.pairs, rotated(covariances, evaluation.T_truth_estimate.T.q));
  const auto inside = std::count_if(nees.begin(), nees.end(), [](double e) { return e <= kChiSquared6At95; });
  const auto defined = [&](double value) {
    return nees.empty() ? std::nullopt : std::optional<double>(value);
  };
  metrics.push_back({"nees_mean", defined(statistics_of(nees).mean)});
  metrics.push_back(
      {"nees_share_within_95",
       defined(static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(1, nees.size())))});
}

}  // namespace

std::optional<double> Evaluation::metric(const std::string& name) const {
  for (const Metric& metric : metrics) {
    if (metric.name == name) return metric.value;
  }
  return std::nullopt;
}

Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationOptions& options,
                    const std::vector<FrameRecord>& frames, const CovarianceLog& covariances) {
  const std::vector<PosePair> raw_pairs = paired(estimate, truth, options);
  Evaluation evaluation;
  evaluation.T_truth_estimate = alignment_of(raw_pairs, options.alignment);
  evaluation.pairs = aligned(raw_pairs, evaluation.T_truth_estimate);
  evaluation.position_errors = position_errors(evaluation.pairs);
  evaluation.rotation_errors = rotation_errors(evaluation.pairs);
  add_extent(evaluation.metrics, evaluation, estimate, truth, options);
  add_position_errors(evaluation.metrics, evaluation);
  add_relative_errors(evaluation.metrics, evaluation, options.relative);
  add_scale(evaluation.metrics, raw_pairs);
  add_collaboration(evaluation.metrics, evaluation, frames);
  add_frames(evaluation.metrics, frames);
  add_consistency(evaluation.metrics, evaluation, covariances);
  return evaluation;
}

}  // namespace cosight
