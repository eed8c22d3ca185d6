#include "shared/evaluation/error_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cosight {

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const double place = std::clamp(q, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

ErrorStatistics statistics_of(std::vector<double> errors) {
  ErrorStatistics statistics;
  if (errors.empty()) return statistics;
  const double count = static_cast<double>(errors.size());
  statistics.count = errors.size();
  statistics.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / count;
  statistics.rmse = std::sqrt(std::inner_product(errors.begin(), errors.end(), errors.begin(), 0.0) / count);
  statistics.max = *std::max_element(errors.begin(), errors.end());
  statistics.median = quantile(std::move(errors), 0.5);
  return statistics;
}

}  // namespace cosight
