#include "robot_agent/vins/linearisation.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace cosight::vins {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
template <int kRows, int kCols>
using RowMajor = Eigen::Matrix<double, kRows, kCols, Eigen::RowMajor>;

// Only the lower triangle of H is filled, and mirrored at the end.

/// Adds the block of two states, or its transpose, where it lies in the lower triangle.
template <class Block>
void add_block(const Block& block, Index row, Index column, MatrixXd& H) {
  if (row >= column) {
    H.block(row, column, block.rows(), block.cols()) += block;
  } else {
    H.block(column, row, block.cols(), block.rows()) += block.transpose();
  }
}

void add_factor(const ceres::CostFunction& factor, const std::vector<StateKey>& keys, FactorGraph& graph,
                const StateLayout& layout, NormalEquations& system) {
  const int rows = factor.num_residuals();
  std::vector<const double*> parameters;
  std::vector<RowMajor<Eigen::Dynamic, Eigen::Dynamic>> J;
  std::vector<double*> pointers;
  for (const StateKey& key : keys) {
    parameters.push_back(graph.block(key));
    J.emplace_back(rows, ambient_size(key.kind));
  }
  for (auto& block : J)
    pointers.push_back(block.data());
  VectorXd r(rows);
  factor.Evaluate(parameters.data(), r.data(), pointers.data());
  for (std::size_t a = 0; a < keys.size(); ++a) {
    const Index column_a = layout.column(keys[a]);
    const auto J_a = J[a].leftCols(tangent_size(keys[a].kind));
    if (column_a < 0) continue;
    system.b.segment(column_a, J_a.cols()) += J_a.transpose() * r;
    for (std::size_t c = 0; c <= a; ++c) {
      const Index column_c = layout.column(keys[c]);
      const auto J_c = J[c].leftCols(tangent_size(keys[c].kind));
      if (column_c >= 0) add_block(MatrixXd(J_a.transpose() * J_c), column_a, column_c, system.H);
    }
  }
}

/// J^T J of the whole prior at once, then block by block to where its states stand.
void add_prior(const PriorFactor& factor, FactorGraph& graph, const StateLayout& layout,
               NormalEquations& system) {
  const Prior& prior = factor.prior();
  std::vector<const double*> parameters;
  for (const Prior::Block& block : prior.blocks)
    parameters.push_back(graph.block(block.key));
  VectorXd r(factor.num_residuals());
  factor.Evaluate(parameters.data(), r.data(), nullptr);
  MatrixXd H = MatrixXd::Zero(prior.J.cols(), prior.J.cols());
  H.selfadjointView<Eigen::Lower>().rankUpdate(prior.J.transpose());
  const VectorXd b = prior.J.transpose() * r;
  Index from_a = 0;
  for (const Prior::Block& a : prior.blocks) {
    const Index size_a = tangent_size(a.key.kind);
    const Index column_a = layout.column(a.key);
    if (column_a >= 0) system.b.segment(column_a, size_a) += b.segment(from_a, size_a);
    Index from_c = 0;
    for (const Prior::Block& c : prior.blocks) {
      if (column_a < 0 || from_c > from_a) break;
      const Index size_c = tangent_size(c.key.kind);
      const Index column_c = layout.column(c.key);
      if (column_c >= 0) add_block(H.block(from_a, from_c, size_a, size_c), column_a, column_c, system.H);
      from_c += size_c;
    }
    from_a += size_a;
  }
}

double kernel_root(const ceres::LossFunction* loss, double squared_norm) {
  if (loss == nullptr) return 1.0;
  std::array<double, 3> rho{};
  loss->Evaluate(squared_norm, rho.data());
  return std::sqrt(rho[1]);
}

/// A landmark's own corner of the normal equations, to be taken out at once. It couples with few of the
/// states, and only their blocks are touched: the poses that saw it, extrinsics, time offset.
class LandmarkCorner {
 public:
  explicit LandmarkCorner(Index size) : cross_(3, size) { cross_.setZero(); }

  void add_host(const FactorGraph::HostTerm& term, const double* landmark) {
    Eigen::Vector2d r;
    RowMajor<2, 3> J;
    double* jacobian = J.data();
    term.factor.Evaluate(&landmark, r.data(), &jacobian);
    const double root = kernel_root(term.loss, r.squaredNorm());
    add(root * J, root * r);
    if (term.distance) add_distance(*term.distance, term.distance_loss, landmark);
  }

  void add(const RowMajor<2, 3>& J, const Eigen::Vector2d& r) {
    H_.noalias() += J.transpose() * J;
    b_.noalias() += J.transpose() * r;
  }

  template <class StateJacobian>
  void couple(const RowMajor<2, 3>& J, const StateJacobian& J_state, Index column) {
    constexpr int kSize = StateJacobian::ColsAtCompileTime;
    const Coupled state{column, kSize};
    if (std::find(coupled_.begin(), coupled_.end(), state) == coupled_.end()) coupled_.push_back(state);
    cross_.template middleCols<kSize>(column).noalias() += J.transpose() * J_state;
  }

  void eliminate(NormalEquations& system) {
    constexpr double kMinInformation = 1e-12;
    const bool is_known = H_(0, 0) > kMinInformation;
    const Eigen::LLT<Eigen::Matrix3d> llt(H_);
    const Eigen::Vector3d half_b = llt.matrixL().solve(b_);
    for (const Coupled& state : coupled_) {
      auto half = cross_.middleCols(state.column, state.size);
      if (is_known) llt.matrixL().solveInPlace(half);
      if (is_known) system.b.segment(state.column, state.size).noalias() -= half.transpose() * half_b;
    }
    for (const Coupled& row : coupled_) {
      for (const Coupled& column : coupled_) {
        if (is_known && row.column >= column.column) subtract(row, column, system.H);
      }
    }
    for (const Coupled& state : coupled_)
      cross_.middleCols(state.column, state.size).setZero();
    coupled_.clear();
    H_.setZero();
    b_.setZero();
  }

 private:
  void add_distance(const DistanceFactor& factor, const ceres::LossFunction* loss, const double* landmark) {
    double r = 0.0;
    RowMajor<1, 3> J;
    double* jacobian = J.data();
    factor.Evaluate(&landmark, &r, &jacobian);
    const double root = kernel_root(loss, r * r);
    H_.noalias() += root * root * J.transpose() * J;
    b_.noalias() += root * root * r * J.transpose();
  }

  struct Coupled {
    Index column;
    Index size;
    bool operator==(const Coupled&) const = default;
  };

  void subtract(const Coupled& row, const Coupled& column, MatrixXd& H) const {
    if (row.size == kPoseDim && column.size == kPoseDim) {
      H.block<kPoseDim, kPoseDim>(row.column, column.column).noalias() -=
          cross_.middleCols<kPoseDim>(row.column).transpose() * cross_.middleCols<kPoseDim>(column.column);
    } else {
      H.block(row.column, column.column, row.size, column.size).noalias() -=
          cross_.middleCols(row.column, row.size).transpose() * cross_.middleCols(column.column, column.size);
    }
  }

  Eigen::Matrix3d H_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b_ = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 3, Eigen::Dynamic> cross_;  ///< of the landmark with every state
  std::vector<Coupled> coupled_;
};

/// Adds what two states of a sighting have in common; `J_a` of the one at `a`, `J_c` of the one at `c`.
template <class JacobianA, class JacobianC>
void add_product(const JacobianA& J_a, Index a, const JacobianC& J_c, Index c, MatrixXd& H) {
  if (a < 0 || c < 0) return;
  add_block((J_a.transpose() * J_c).eval(), a, c, H);
}

void add_visual(const FactorGraph::VisualTerm& term, FactorGraph& graph, const StateLayout& layout,
                NormalEquations& system, LandmarkCorner& corner) {
  const auto blocks = graph.blocks(term);
  const auto keys = graph.pose_keys(term);
  const std::array<Index, 3> columns{layout.column(keys[0]), layout.column(keys[1]),
                                     layout.column({StateKind::kExtrinsics, 0})};
  const Index offset = layout.column({StateKind::kTimeOffset, 0});
  std::array<RowMajor<2, 7>, 3> ambient;
  Eigen::Vector2d r;
  RowMajor<2, 3> J_landmark;
  Eigen::Vector2d J_offset;
  std::array<double*, 5> jacobians{ambient[0].data(), ambient[1].data(),
                                   columns[2] < 0 ? nullptr : ambient[2].data(), J_landmark.data(),
                                   offset < 0 ? nullptr : J_offset.data()};
  term.factor.Evaluate(blocks.data(), r.data(), jacobians.data());
  const double root = kernel_root(term.loss, r.squaredNorm());
  r *= root;
  J_landmark *= root;
  J_offset *= root;
  corner.add(J_landmark, r);
  std::array<Eigen::Matrix<double, 2, kPoseDim>, 3> J;
  for (std::size_t a = 0; a < J.size(); ++a) {
    if (columns[a] < 0) continue;
    J[a] = root * ambient[a].leftCols<kPoseDim>();
    system.b.segment<kPoseDim>(columns[a]).noalias() += J[a].transpose() * r;
    corner.couple(J_landmark, J[a], columns[a]);
    for (std::size_t c = 0; c <= a; ++c)
      add_product(J[a], columns[a], J[c], columns[c], system.H);
    add_product(J_offset, offset, J[a], columns[a], system.H);
  }
  if (offset < 0) return;
  system.b(offset) += J_offset.dot(r);
  corner.couple(J_landmark, J_offset, offset);
  system.H(offset, offset) += J_offset.squaredNorm();
}

}  // namespace

NormalEquations linearise(FactorGraph& graph, const StateLayout& layout) {
  NormalEquations system{MatrixXd::Zero(layout.size(), layout.size()), VectorXd::Zero(layout.size())};
  LandmarkCorner corner(layout.size());
  auto term = graph.visual_terms().begin();
  for (std::size_t l = 0; l < graph.landmark_count(); ++l) {
    corner.add_host(graph.host_term(l), graph.landmark(l));
    for (; term != graph.visual_terms().end() && term->landmark == l; ++term)
      add_visual(*term, graph, layout, system, corner);
    corner.eliminate(system);
  }
  for (const auto& imu : graph.imu_terms()) {
    const auto keys = graph.keys(imu);
    add_factor(imu.factor, {keys.begin(), keys.end()}, graph, layout, system);
  }
  if (graph.prior() != nullptr) add_prior(*graph.prior(), graph, layout, system);
  system.H.triangularView<Eigen::StrictlyUpper>() = system.H.transpose();
  return system;
}

StateLayout::StateLayout(std::vector<StateKey> keys, const std::vector<StateKey>& first) {
  const auto goes_first = [&](const StateKey& key) {
    return std::find(first.begin(), first.end(), key) != first.end();
  };
  std::stable_partition(keys.begin(), keys.end(), goes_first);
  for (const StateKey& key : keys) {
    places_.push_back({key, size_});
    size_ += tangent_size(key.kind);
    if (goes_first(key)) first_size_ = size_;
  }
}

Index StateLayout::column(StateKey key) const {
  const auto place =
      std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.key == key; });
  return place == places_.end() ? -1 : place->column;
}

std::vector<StateKey> StateLayout::rest() const {
  std::vector<StateKey> keys;
  for (const Place& place : places_) {
    if (place.column >= first_size_) keys.push_back(place.key);
  }
  return keys;
}

}  // namespace cosight::vins
