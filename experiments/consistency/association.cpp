#include "experiments/consistency/association.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <limits>

namespace cosight::experiments {
namespace {

constexpr int kTabulatedRows = 400;

/// S whole, from its lower triangle.
Eigen::MatrixXd whole_S(const ekf::JointInnovation& innovation) {
  return innovation.S_lower().selfadjointView<Eigen::Lower>();
}

}  // namespace

BranchAndBound::BranchAndBound(double probability, int max_nodes)
    : limits_(probability, kTabulatedRows), max_nodes_(max_nodes) {}

std::vector<char> BranchAndBound::test(const ekf::JointInnovation& innovation) {
  const std::size_t pairings = innovation.measurements().size();
  innovation_ = &innovation;
  L_.setZero(innovation.rows(), innovation.rows());
  whitened_.setZero(innovation.rows());
  rows_of_state_.assign(static_cast<std::size_t>(innovation.rows()), 0);
  keep_.assign(pairings, 0);
  best_.assign(pairings, 0);
  best_accepted_ = -1;
  best_distance_ = std::numeric_limits<double>::infinity();
  nodes_ = 0;
  search(0, 0, 0, 0.0);
  return best_;
}

/// The set so far has `rows` rows in L_; the next pairing is taken in, if that is compatible, or left out, if
/// the rest could still beat the best.
void BranchAndBound::search(std::size_t pairing, int rows, int accepted, double distance) {
  const auto measurements = innovation_->measurements();
  if (++nodes_ >= max_nodes_ && best_accepted_ >= 0) return;
  if (pairing == measurements.size()) {
    if (accepted > best_accepted_ || (accepted == best_accepted_ && distance < best_distance_)) {
      best_ = keep_;
      best_accepted_ = accepted;
      best_distance_ = distance;
    }
    return;
  }
  const ekf::LinearisedMeasurement& m = measurements[pairing];
  const auto S = innovation_->S_lower();
  for (int k = 0; k < m.rows; ++k) {
    for (int j = 0; j < rows; ++j)
      L_(rows + k, j) = S(m.row + k, rows_of_state_[static_cast<std::size_t>(j)]);
    rows_of_state_[static_cast<std::size_t>(rows + k)] = m.row + k;
  }
  // L_new L^T = S_new,old;  L_own L_own^T = S_own - L_new L_new^T.
  auto L_new = L_.block(rows, 0, m.rows, rows);
  L_.topLeftCorner(rows, rows)
      .triangularView<Eigen::Lower>()
      .transpose()
      .solveInPlace<Eigen::OnTheRight>(L_new);
  const Eigen::MatrixXd own =
      Eigen::MatrixXd(S.block(m.row, m.row, m.rows, m.rows).selfadjointView<Eigen::Lower>()) -
      L_new * L_new.transpose();
  const Eigen::MatrixXd L_own = own.llt().matrixL();
  const Eigen::VectorXd y = L_own.triangularView<Eigen::Lower>().solve(
      innovation_->g().segment(m.row, m.rows) - L_new * whitened_.head(rows));
  const double longer = distance + y.squaredNorm();
  if (longer <= limits_(rows + m.rows)) {
    L_.block(rows, rows, m.rows, m.rows) = L_own;
    whitened_.segment(rows, m.rows) = y;
    keep_[pairing] = 1;
    search(pairing + 1, rows + m.rows, accepted + 1, longer);
    keep_[pairing] = 0;
  }
  const int remaining = static_cast<int>(measurements.size() - pairing) - 1;
  if (accepted + remaining > best_accepted_) search(pairing + 1, rows, accepted, distance);
}

std::vector<char> one_point_ransac(const ekf::JointInnovation& innovation, double threshold_px,
                                   double rescue_probability) {
  const auto measurements = innovation.measurements();
  const Eigen::MatrixXd S = whole_S(innovation);
  const Eigen::VectorXd g = innovation.g();
  std::vector<char> best(measurements.size(), 0);
  std::ptrdiff_t most = 0;
  for (const ekf::LinearisedMeasurement& one : measurements) {
    const Eigen::VectorXd step =
        S.block(one.row, one.row, one.rows, one.rows).llt().solve(g.segment(one.row, one.rows));
    const Eigen::VectorXd residual = g - S.middleCols(one.row, one.rows) * step;
    std::vector<char> inliers;
    for (const ekf::LinearisedMeasurement& m : measurements)
      inliers.push_back(&m == &one || residual.segment(m.row, m.rows).norm() < threshold_px ? 1 : 0);
    const std::ptrdiff_t count = std::count(inliers.begin(), inliers.end(), 1);
    if (count <= most) continue;
    most = count;
    best = inliers;
  }
  std::vector<int> kept;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    for (int k = 0; best[i] != 0 && k < measurements[i].rows; ++k)
      kept.push_back(measurements[i].row + k);
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(S(kept, kept));
  const Eigen::VectorXd by_winners = llt.solve(Eigen::VectorXd(g(kept)));
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (best[i] != 0) continue;
    const ekf::LinearisedMeasurement& m = measurements[i];
    const Eigen::MatrixXd cross = S.middleRows(m.row, m.rows)(Eigen::all, kept);
    const Eigen::VectorXd residual = g.segment(m.row, m.rows) - cross * by_winners;
    const Eigen::MatrixXd covariance =
        S.block(m.row, m.row, m.rows, m.rows) - cross * llt.solve(cross.transpose());
    const double distance = residual.dot(covariance.llt().solve(residual));
    if (distance <= ekf::chi_squared_quantile(rescue_probability, m.rows)) best[i] = 1;
  }
  return best;
}

Validator::Validator(Validation validation)
    : validation_(validation),
      joint_compatibility_({.each_probability = validation == Validation::kHohct ? 1.0 : 0.99}) {}

std::vector<char> Validator::test(const ekf::JointInnovation& innovation) {
  switch (validation_) {
    case Validation::kHohct:
    case Validation::kHohctThenEach:
      return joint_compatibility_.test(innovation).keep;
    case Validation::kJcbb:
      return branch_and_bound_.test(innovation);
    case Validation::kOnePointRansac:
      return one_point_ransac(innovation);
    case Validation::kNone:
    case Validation::kGate:
      break;
  }
  return std::vector<char>(innovation.measurements().size(), 1);
}

}  // namespace cosight::experiments
