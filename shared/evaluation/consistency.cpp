#include "shared/evaluation/consistency.hpp"

#include <Eigen/Cholesky>
#include <string>

#include "shared/evaluation/csv_table.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

Vector6d pose_error(const PosePair& pair) {
  Vector6d error;
  error << pair.T_WC_truth.p - pair.T_WC_estimate.p,
      quaternion_log(pair.T_WC_truth.q * pair.T_WC_estimate.q.conjugate());
  return error;
}

}  // namespace

CovarianceLog read_covariance_log(const std::filesystem::path& path) {
  const CsvTable table = CsvTable::read(path);
  CovarianceLog log;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Eigen::Matrix<double, 6, 6> P;
    for (int i = 0; i < 6; ++i) {
      for (int j = i; j < 6; ++j) {
        std::string column = "c";
        column += std::to_string(i) + std::to_string(j);
        P(i, j) = table.number(row, column);
        P(j, i) = P(i, j);
      }
    }
    log[table.stamp(row, "stamp_ns")] = P;
  }
  return log;
}

std::vector<double> normalised_errors(const std::vector<PosePair>& pairs, const CovarianceLog& covariances) {
  std::vector<double> nees;
  for (const PosePair& pair : pairs) {
    const auto found = covariances.find(pair.stamp);
    if (found == covariances.end()) continue;
    const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factor(found->second);
    if (factor.info() != Eigen::Success) continue;
    const Vector6d error = pose_error(pair);
    nees.push_back(error.dot(factor.solve(error)));
  }
  return nees;
}

}  // namespace cosight
