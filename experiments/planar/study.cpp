#include "experiments/planar/study.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace cosight::experiments {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

double mean_position_error(const TrialResult& trial) {
  std::vector<double> errors;
  for (const TrialStep& step : trial.steps)
    errors.push_back(step.position_error);
  return mean(errors);
}

template <class Value>
std::vector<double> of_each(const std::vector<TrialResult>& trials, Value value) {
  std::vector<double> values;
  for (const TrialResult& trial : trials)
    values.push_back(value(trial));
  return values;
}

}  // namespace

std::vector<TrialResult> run_trials(const TrialOptions& options, unsigned first_seed, int runs) {
  std::vector<TrialResult> trials;
  for (int i = 0; i < runs; ++i)
    trials.push_back(run_trial(first_seed + static_cast<unsigned>(i), options));
  return trials;
}

MeanCourse mean_course(const std::vector<TrialResult>& trials) {
  MeanCourse course;
  for (std::size_t k = 0; k < trials.front().steps.size(); ++k) {
    std::vector<double> scale = of_each(trials, [k](const auto& t) { return t.steps[k].scale_error; });
    std::erase_if(scale, [](double s) { return !std::isfinite(s); });
    course.t.push_back(trials.front().steps[k].t);
    course.position_error.push_back(
        mean(of_each(trials, [k](const auto& t) { return t.steps[k].position_error; })));
    course.scale_error.push_back(scale.empty() ? std::numeric_limits<double>::quiet_NaN() : mean(scale));
    course.position_sigma.push_back(
        mean(of_each(trials, [k](const auto& t) { return t.steps[k].position_sigma; })));
  }
  return course;
}

bool is_diverged(const TrialResult& trial, const WallWorldOptions& world) {
  return !(trial.steps.back().position_error <= 0.5 * world.path);
}

void summarise(const std::vector<TrialResult>& trials, const WallWorldOptions& world, const std::string& mode,
               Figures& figures) {
  const std::vector<double> finals =
      of_each(trials, [](const auto& t) { return t.steps.back().position_error; });
  const std::vector<double> headings =
      of_each(trials, [](const auto& t) { return t.steps.back().heading_error * 180.0 / std::numbers::pi; });
  figures.set(mode, "final_error_m_mean", mean(finals));
  figures.set(mode, "final_error_m_median", median(finals));
  figures.set(mode, "final_error_m_max", *std::max_element(finals.begin(), finals.end()));
  figures.set(mode, "error_m_mean", mean(of_each(trials, mean_position_error)));
  figures.set(mode, "heading_error_deg_max", *std::max_element(headings.begin(), headings.end()));
  figures.set(mode, "final_scale_error_mean",
              mean(of_each(trials, [](const auto& t) { return t.steps.back().scale_error; })));
  figures.set(mode, "diverged",
              static_cast<double>(std::count_if(trials.begin(), trials.end(),
                                                [&](const auto& t) { return is_diverged(t, world); })));
  figures.set(mode, "runs", static_cast<double>(trials.size()));
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const auto centred = [](const std::vector<double>& values) {
    const Eigen::Map<const Eigen::VectorXd> all(values.data(), static_cast<Eigen::Index>(values.size()));
    return Eigen::VectorXd(all.array() - all.mean());
  };
  const Eigen::VectorXd da = centred(a);
  const Eigen::VectorXd db = centred(b);
  return da.dot(db) / (da.norm() * db.norm());
}

const TrialResult& median_trial(const std::vector<TrialResult>& trials) {
  std::vector<const TrialResult*> order;
  for (const TrialResult& trial : trials)
    order.push_back(&trial);
  std::sort(order.begin(), order.end(), [](const TrialResult* a, const TrialResult* b) {
    return a->steps.back().position_error < b->steps.back().position_error;
  });
  return *order[order.size() / 2];
}

}  // namespace cosight::experiments
