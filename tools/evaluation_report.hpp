#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shared/evaluation/evaluation.hpp"

namespace cosight {

/// Two columns for a terminal, "n/a" where a metric is not defined.
std::string metrics_table(const std::vector<Metric>& metrics);

/// {"ate_m": 0.012, …}, null where not defined. Throws EvaluationError when it can't be written.
void write_metrics_json(const std::filesystem::path& path, const std::vector<Metric>& metrics);

/// What write_metrics_json wrote. Throws EvaluationError.
std::vector<Metric> read_metrics_json(const std::filesystem::path& path);

/// One row a compared pose: stamp, both positions, both errors. Throws EvaluationError.
void write_errors_csv(const std::filesystem::path& path, const Evaluation& evaluation);

}  // namespace cosight
