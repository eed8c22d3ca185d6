#pragma once

#include <cstddef>
#include <vector>

namespace cosight {

/// Of a list of error magnitudes; unit of the list.
struct ErrorStatistics {
  std::size_t count = 0;
  double rmse = 0.0;
  double mean = 0.0;
  double median = 0.0;
  double max = 0.0;
};

/// All zero for an empty list.
ErrorStatistics statistics_of(std::vector<double> errors);

/// The value below which the share `q` in [0, 1] of the values lies, interpolated between neighbours; zero
/// for an empty list.
double quantile(std::vector<double> values, double q);

}  // namespace cosight
