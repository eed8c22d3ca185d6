#include "robot_agent/ekf/joint_innovation.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace cosight::ekf {
namespace {

constexpr int kPose = CameraState::kPoseDim;

/// product += P(:, o:o+Dim) H^T of one block, from the lower triangle of P.
template <int Rows, int Dim>
void add_touched_columns(const Eigen::Ref<const Eigen::MatrixXd>& P, Eigen::Index o,
                         const Eigen::Matrix<double, Dim, Rows>& H_t, Eigen::Ref<Eigen::MatrixXd> product) {
  Eigen::Matrix<double, Dim, Dim> P_oo = P.block<Dim, Dim>(o, o);
  P_oo.template triangularView<Eigen::StrictlyUpper>() = P_oo.transpose();
  product.middleRows<Dim>(o) += P_oo * H_t;
  const Eigen::Index below = P.rows() - o - Dim;
  product.bottomRows(below) += P.block(o + Dim, o, below, Dim).lazyProduct(H_t);
  for (Eigen::Index j = 0; j < o; ++j) {  // above the diagonal block: P(j, o:o+Dim) = P(o:o+Dim, j)^T
    const Eigen::Matrix<double, Dim, 1> p = P.template block<Dim, 1>(o, j);
    product.row(j) += (p.transpose() * H_t);
  }
}

/// P H^T of one measurement, in the columns [row, row + Rows), from the touched columns of P only.
template <int Rows, int Dim>
void multiply_touched_columns(const Eigen::Ref<const Eigen::MatrixXd>& P, const LinearisedMeasurement& m,
                              Eigen::Ref<Eigen::MatrixXd> product) {
  const Eigen::Index n = P.rows();
  const Eigen::Matrix<double, kPose, Rows> Hc_t = m.H_camera.topRows<Rows>().transpose();
  const Eigen::Matrix<double, Dim, Rows> Hl_t = m.H_landmark.topLeftCorner<Rows, Dim>().transpose();

  Eigen::Matrix<double, kPose, kPose> P_cc = P.topLeftCorner<kPose, kPose>();
  P_cc.triangularView<Eigen::StrictlyUpper>() = P_cc.transpose();
  product.topRows<kPose>() = P_cc * Hc_t;
  product.bottomRows(n - kPose) = P.block(kPose, 0, n - kPose, kPose).lazyProduct(Hc_t);

  add_touched_columns<Rows, Dim>(P, m.offset, Hl_t, product);
}

/// The rows of S of one measurement up to its diagonal block, from P H^T.
template <int Rows, int Dim>
void multiply_rows(const Eigen::Ref<const Eigen::MatrixXd>& P_Ht, const LinearisedMeasurement& m,
                   Eigen::Ref<Eigen::MatrixXd> S_rows) {
  const Eigen::Index columns = S_rows.cols();
  S_rows = m.H_camera.topRows<Rows>().lazyProduct(P_Ht.topLeftCorner(kPose, columns));
  S_rows += m.H_landmark.topLeftCorner<Rows, Dim>().lazyProduct(P_Ht.block(m.offset, 0, Dim, columns));
}

/// What rounding may make of row `k` of H P H^T: a share of its largest possible value, (sum |H_kj|
/// sigma_j)^2. Added to R, or a sharp measurement after a long gap would be believed beyond the digits that P
/// has.
double rounding_variance(const GaussianState& state, const LinearisedMeasurement& m, int k) {
  constexpr double kRounding = 1e-12;
  const auto P = state.P_lower();
  double sigma = 0.0;
  for (int j = 0; j < kPose; ++j)
    sigma += std::abs(m.H_camera(k, j)) * std::sqrt(P(j, j));
  for (int j = 0; j < m.dim; ++j) {
    sigma += std::abs(m.H_landmark(k, j)) * std::sqrt(P(m.offset + j, m.offset + j));
  }
  for (int j = 0; m.sees_rig_error && j < RigError::kDim; ++j) {
    sigma += std::abs(m.H_rig(k, j)) * std::sqrt(P(RigError::kOffset + j, RigError::kOffset + j));
  }
  return kRounding * sigma * sigma;
}

double normalised_innovation_squared(const Eigen::Matrix3d& S_ii, const Eigen::Vector3d& g, int rows) {
  const auto nis = [](const auto& S, const auto& v) {
    const Eigen::LLT<std::decay_t<decltype(S)>> llt(S);
    if (llt.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    return llt.matrixL().solve(v).squaredNorm();
  };
  if (rows == 2) {
    const Eigen::Matrix2d S = S_ii.topLeftCorner<2, 2>();
    const Eigen::Vector2d v = g.head<2>();
    return nis(S, v);
  }
  return nis(S_ii, g);
}

}  // namespace

JointInnovation::JointInnovation(int state_capacity, int row_capacity)
    : g_(Eigen::VectorXd::Zero(row_capacity)),
      P_Ht_(Eigen::MatrixXd::Zero((state_capacity + 7) / 8 * 8, row_capacity)),
      S_(Eigen::MatrixXd::Zero(row_capacity, row_capacity)) {
  measurements_.reserve(static_cast<std::size_t>(row_capacity) / 2 + 1);
}

void JointInnovation::clear() {
  measurements_.clear();
  rows_ = 0;
}

void JointInnovation::push_back(const LinearisedMeasurement& measurement) {
  if (rows_ + measurement.rows > g_.size()) {  // more than one measurement a landmark: not the usual case
    const Eigen::Index capacity = 2 * (rows_ + measurement.rows);
    g_.conservativeResize(capacity);
    P_Ht_.resize(P_Ht_.rows(), capacity);
    S_.resize(capacity, capacity);
  }
  measurements_.push_back(measurement);
  measurements_.back().row = rows_;
  g_.segment(rows_, measurement.rows) = measurement.innovation.head(measurement.rows);
  rows_ += measurement.rows;
}

void JointInnovation::compute(const GaussianState& state, bool correlated) {
  state_size_ = state.size();
  for (const LinearisedMeasurement& m : measurements_)
    add_row_products(state, m);
  for (LinearisedMeasurement& m : measurements_) {
    add_innovation_covariance(m);
    auto S_ii = S_.block(m.row, m.row, m.rows, m.rows);
    S_ii += m.R.topLeftCorner(m.rows, m.rows);
    for (int k = 0; k < m.rows; ++k)
      S_ii(k, k) += rounding_variance(state, m, k);
    Eigen::Matrix3d block = Eigen::Matrix3d::Identity();
    block.topLeftCorner(m.rows, m.rows) = S_ii;
    m.nis = normalised_innovation_squared(block, m.innovation, m.rows);
  }
  if (correlated) add_shared_errors();
}

/// B_a B_b^T of every pair that shares the error of T_SF, below the diagonal.
void JointInnovation::add_shared_errors() {
  for (const LinearisedMeasurement& a : measurements_) {
    if (!a.shares_error) continue;
    for (const LinearisedMeasurement& b : measurements_) {
      if (b.row >= a.row) break;
      if (!b.shares_error) continue;
      const Eigen::Matrix3d shared = a.shared_factor * b.shared_factor.transpose();
      S_.block(a.row, b.row, a.rows, b.rows) += shared.topLeftCorner(a.rows, b.rows);
    }
  }
}

void JointInnovation::add_row_products(const GaussianState& state, const LinearisedMeasurement& m) {
  auto columns = P_Ht_.block(0, m.row, state_size_, m.rows);
  const bool inverse_depth = m.dim == InverseDepthPoint::kDim;
  if (m.rows == 2 && inverse_depth) {
    multiply_touched_columns<2, 6>(state.P_lower(), m, columns);
  } else if (m.rows == 2) {
    multiply_touched_columns<2, 3>(state.P_lower(), m, columns);
  } else if (inverse_depth) {
    multiply_touched_columns<3, 6>(state.P_lower(), m, columns);
  } else {
    multiply_touched_columns<3, 3>(state.P_lower(), m, columns);
  }
  if (m.sees_rig_error) {
    const Eigen::Matrix<double, RigError::kDim, 2> H_t = m.H_rig.transpose();
    add_touched_columns<2, RigError::kDim>(state.P_lower(), RigError::kOffset, H_t, columns);
  }
}

void JointInnovation::add_innovation_covariance(const LinearisedMeasurement& m) {
  auto rows = S_.block(m.row, 0, m.rows, m.row + m.rows);
  const bool inverse_depth = m.dim == InverseDepthPoint::kDim;
  if (m.rows == 2 && inverse_depth) {
    multiply_rows<2, 6>(P_Ht_, m, rows);
  } else if (m.rows == 2) {
    multiply_rows<2, 3>(P_Ht_, m, rows);
  } else if (inverse_depth) {
    multiply_rows<3, 6>(P_Ht_, m, rows);
  } else {
    multiply_rows<3, 3>(P_Ht_, m, rows);
  }
  if (m.sees_rig_error)
    rows += m.H_rig.lazyProduct(P_Ht_.block(RigError::kOffset, 0, RigError::kDim, rows.cols()));
}

void JointInnovation::keep_only(std::span<const char> keep) {
  std::size_t kept = 0;
  int row = 0;
  for (std::size_t i = 0; i < measurements_.size(); ++i) {
    if (keep[i] == 0) continue;
    LinearisedMeasurement& m = measurements_[i];
    if (m.row != row) {  // what moves only ever moves towards the start
      for (int k = 0; k < m.rows; ++k) {
        g_(row + k) = g_(m.row + k);
        P_Ht_.col(row + k).head(state_size_) = P_Ht_.col(m.row + k).head(state_size_);
        for (int j = 0; j < rows_; ++j)
          S_(row + k, j) = S_(m.row + k, j);
      }
      for (int k = 0; k < m.rows; ++k) {
        for (int i_row = row; i_row < rows_; ++i_row)
          S_(i_row, row + k) = S_(i_row, m.row + k);
      }
    }
    m.row = row;
    row += m.rows;
    if (kept != i) measurements_[kept] = m;
    ++kept;
  }
  measurements_.resize(kept);
  rows_ = row;
}

}  // namespace cosight::ekf
