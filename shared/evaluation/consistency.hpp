#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <vector>

#include "shared/evaluation/association.hpp"

namespace cosight {

/// Covariance of each estimated pose's [dp, dtheta] in the axes of W, as UncertainPose has it, by stamp.
using CovarianceLog = std::map<Stamp, Eigen::Matrix<double, 6, 6>>;

/// Reads "stamp_ns,c00,c01,…,c55": the 21 entries of the upper triangle, row by row. Throws EvaluationError.
CovarianceLog read_covariance_log(const std::filesystem::path& path);

/// Normalised squared error e^T P^-1 e of each pose that has a covariance, e = [p_truth - p_estimate,
/// Log(R_truth R_estimate^T)]; expected to average 6. A pose with a singular covariance (known exactly) is
/// left out.
std::vector<double> normalised_errors(const std::vector<PosePair>& pairs, const CovarianceLog& covariances);

/// 95 % of the normalised errors of six degrees of freedom lie below this (chi squared).
constexpr double kChiSquared6At95 = 12.591587;

}  // namespace cosight
