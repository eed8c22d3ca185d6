#pragma once

#include <Eigen/Core>
#include <span>

namespace cosight::ekf {

/// x ~ N(x_hat, P) of varying size in storage that is allocated once. Only the lower triangle of P is kept
/// and valid: it is symmetric by construction.
class GaussianState {
 public:
  explicit GaussianState(int capacity);

  int size() const { return size_; }
  int capacity() const { return static_cast<int>(x_.size()); }
  bool has_room_for(int dim) const { return size_ + dim <= capacity(); }

  auto x() { return x_.head(size_); }
  auto x() const { return x_.head(size_); }
  auto P_lower() { return P_.topLeftCorner(size_, size_); }
  auto P_lower() const { return P_.topLeftCorner(size_, size_); }

  /// The block of P in rows [row, row + Rows) and columns [column, column + Cols), read from the lower
  /// triangle.
  template <int Rows, int Cols>
  Eigen::Matrix<double, Rows, Cols> covariance(int row, int column) const {
    Eigen::Matrix<double, Rows, Cols> block;
    for (int j = 0; j < Cols; ++j) {
      for (int i = 0; i < Rows; ++i)
        block(i, j) = at(row + i, column + j);
    }
    return block;
  }

  /// One block that a new block is a function of.
  struct Dependence {
    static constexpr int kMaxDim = 7;
    int offset = 0;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxDim, kMaxDim> J;
  };

  /// Appends y = f(x, n): P grows by the rows [sum_k J_k P(k, :)] and sum_kl J_k P(k, l) J_l^T + noise (C8).
  /// There must be room. Returns the new block's offset.
  int append(const Eigen::Ref<const Eigen::VectorXd>& y, std::span<const Dependence> dependences,
             const Eigen::Ref<const Eigen::MatrixXd>& noise);

  /// Replaces the block [offset, offset + dim) by y = f(block), dim(y) <= dim: P goes through J (dim(y) x
  /// dim).
  void transform(int offset, const Eigen::Ref<const Eigen::VectorXd>& y,
                 const Eigen::Ref<const Eigen::MatrixXd>& J);

  /// Takes the block [offset, offset + dim) out (marginalises it); what follows moves up.
  void remove(int offset, int dim);

 private:
  double at(int i, int j) const { return i >= j ? P_(i, j) : P_(j, i); }

  int size_ = 0;
  Eigen::VectorXd x_;
  Eigen::MatrixXd P_;
};

}  // namespace cosight::ekf
