#include "robot_agent/ekf/gaussian_state.hpp"

#include <algorithm>
#include <cassert>

namespace cosight::ekf {
namespace {

using Eigen::Index;

/// Rows of the storage: a multiple of a cache line, but not of many, or all columns would fight for one set.
int padded(int capacity) {
  constexpr int kLine = 8;  // doubles
  int rows = (capacity + kLine - 1) / kLine * kLine;
  if (rows % (8 * kLine) == 0) rows += kLine;
  return rows;
}

}  // namespace

GaussianState::GaussianState(int capacity)
    : x_(Eigen::VectorXd::Zero(capacity)), P_(Eigen::MatrixXd::Zero(padded(capacity), capacity)) {}

int GaussianState::append(const Eigen::Ref<const Eigen::VectorXd>& y, std::span<const Dependence> dependences,
                          const Eigen::Ref<const Eigen::MatrixXd>& noise) {
  const int dim = static_cast<int>(y.size());
  const int offset = size_;
  assert(has_room_for(dim));
  for (int j = 0; j < offset; ++j) {  // cross-covariance, a column at a time
    for (int a = 0; a < dim; ++a) {
      double sum = 0.0;
      for (const Dependence& source : dependences) {
        for (Index c = 0; c < source.J.cols(); ++c)
          sum += source.J(a, c) * at(source.offset + static_cast<int>(c), j);
      }
      P_(offset + a, j) = sum;
    }
  }
  auto P_yy = P_.block(offset, offset, dim, dim);
  P_yy = noise;
  for (const Dependence& source : dependences) {
    P_yy += P_.block(offset, source.offset, dim, source.J.cols()).lazyProduct(source.J.transpose());
  }
  x_.segment(offset, dim) = y;
  size_ += dim;
  return offset;
}

void GaussianState::transform(int offset, const Eigen::Ref<const Eigen::VectorXd>& y,
                              const Eigen::Ref<const Eigen::MatrixXd>& J) {
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 7, 7>;
  using Panel = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, 7>;
  const int dim = static_cast<int>(J.cols());
  const int new_dim = static_cast<int>(y.size());
  assert(new_dim <= dim && dim <= 7);
  Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 7, 1> column(dim);
  for (int j = 0; j < offset; ++j) {
    column = P_.col(j).segment(offset, dim);
    P_.col(j).segment(offset, new_dim) = J.lazyProduct(column);
  }
  Small P_bb(dim, dim);
  for (int j = 0; j < dim; ++j) {
    for (int i = 0; i < dim; ++i)
      P_bb(i, j) = at(offset + i, offset + j);
  }
  const Small J_P = J.lazyProduct(P_bb);
  P_.block(offset, offset, new_dim, new_dim) = J_P.lazyProduct(J.transpose());
  Panel row(dim);
  for (int i = offset + dim; i < size_; ++i) {
    row = P_.row(i).segment(offset, dim);
    P_.row(i).segment(offset, new_dim) = row.lazyProduct(J.transpose());
  }
  x_.segment(offset, new_dim) = y;
  if (new_dim < dim) remove(offset + new_dim, dim - new_dim);
}

void GaussianState::remove(int offset, int dim) {
  assert(offset + dim <= size_);
  const int end = offset + dim;
  std::copy(x_.data() + end, x_.data() + size_, x_.data() + offset);
  for (int j = 0; j < offset; ++j) {  // rows below move up
    double* column = P_.col(j).data();
    std::copy(column + end, column + size_, column + offset);
  }
  for (int j = end; j < size_; ++j) {  // columns behind move up and to the left
    const double* from = P_.col(j).data();
    std::copy(from + j, from + size_, P_.col(j - dim).data() + (j - dim));
  }
  size_ -= dim;
}

}  // namespace cosight::ekf
