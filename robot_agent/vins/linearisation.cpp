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

/// Adds a factor's J^T J and J^T r for the blocks whose column is not negative. `J` in tangent columns.
void accumulate(const std::vector<MatrixXd>& J, const std::vector<Index>& columns, const VectorXd& r,
                NormalEquations& system) {
  for (std::size_t a = 0; a < J.size(); ++a) {
    if (columns[a] < 0) continue;
    system.b.segment(columns[a], J[a].cols()) += J[a].transpose() * r;
    for (std::size_t c = 0; c < J.size(); ++c) {
      if (columns[c] < 0) continue;
      system.H.block(columns[a], columns[c], J[a].cols(), J[c].cols()).noalias() += J[a].transpose() * J[c];
    }
  }
}

void add_factor(const ceres::CostFunction& factor, const std::vector<StateKey>& keys, FactorGraph& graph,
                const StateLayout& layout, NormalEquations& system) {
  const int rows = factor.num_residuals();
  std::vector<const double*> parameters;
  std::vector<RowMajor<Eigen::Dynamic, Eigen::Dynamic>> ambient;
  std::vector<double*> pointers;
  std::vector<Index> columns;
  for (const StateKey& key : keys) {
    parameters.push_back(graph.block(key));
    ambient.emplace_back(rows, ambient_size(key.kind));
    columns.push_back(layout.column(key));
  }
  for (auto& J : ambient)
    pointers.push_back(J.data());
  VectorXd r(rows);
  factor.Evaluate(parameters.data(), r.data(), pointers.data());
  std::vector<MatrixXd> tangent;
  for (std::size_t i = 0; i < keys.size(); ++i)
    tangent.push_back(ambient[i].leftCols(tangent_size(keys[i].kind)));
  accumulate(tangent, columns, r, system);
}

double kernel_root(const ceres::LossFunction* loss, const Eigen::Vector2d& r) {
  if (loss == nullptr) return 1.0;
  std::array<double, 3> rho{};
  loss->Evaluate(r.squaredNorm(), rho.data());
  return std::sqrt(rho[1]);
}

/// A landmark's own corner of the normal equations, to be taken out at once.
struct LandmarkCorner {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, Eigen::Dynamic, 3> cross;  ///< of every state with the landmark

  explicit LandmarkCorner(Index size) : cross(size, 3) { cross.setZero(); }

  void add_host(const FactorGraph::HostTerm& term, const double* landmark) {
    Eigen::Vector2d r;
    RowMajor<2, 3> J;
    double* jacobian = J.data();
    term.factor.Evaluate(&landmark, r.data(), &jacobian);
    const double weight = std::pow(kernel_root(term.loss, r), 2);
    H += weight * J.transpose() * J;
    b += weight * J.transpose() * r;
  }

  void eliminate(NormalEquations& system) {
    constexpr double kMinInformation = 1e-12;
    if (H(0, 0) > kMinInformation) {
      const Eigen::LLT<Eigen::Matrix3d> llt(H);
      const Eigen::Matrix<double, 3, Eigen::Dynamic> half = llt.matrixL().solve(cross.transpose());
      system.H.noalias() -= half.transpose() * half;
      system.b.noalias() -= half.transpose() * llt.matrixL().solve(b);
    }
    H.setZero();
    b.setZero();
    cross.setZero();
  }
};

void add_visual(const FactorGraph::VisualTerm& term, FactorGraph& graph, const StateLayout& layout,
                NormalEquations& system, LandmarkCorner& corner) {
  const auto blocks = graph.blocks(term);
  const auto poses = graph.pose_keys(term);
  const std::array<Index, 4> columns{layout.column(poses[0]), layout.column(poses[1]),
                                     layout.column({StateKind::kExtrinsics, 0}),
                                     layout.column({StateKind::kTimeOffset, 0})};
  std::array<RowMajor<2, 7>, 3> J_pose;
  Eigen::Vector2d r;
  RowMajor<2, 3> J_landmark;
  Eigen::Vector2d J_offset;
  std::array<double*, 5> jacobians{J_pose[0].data(), J_pose[1].data(), J_pose[2].data(), J_landmark.data(),
                                   J_offset.data()};
  term.factor.Evaluate(blocks.data(), r.data(), jacobians.data());
  const double root = kernel_root(term.loss, r);
  Eigen::Matrix<double, 2, 19> J;
  J << J_pose[0].leftCols<6>(), J_pose[1].leftCols<6>(), J_pose[2].leftCols<6>(), J_offset;
  J *= root;
  r *= root;
  J_landmark *= root;
  corner.H += J_landmark.transpose() * J_landmark;
  corner.b += J_landmark.transpose() * r;
  constexpr std::array<Index, 4> kStart{0, 6, 12, 18};
  constexpr std::array<Index, 4> kSize{6, 6, 6, 1};
  for (std::size_t a = 0; a < 4; ++a) {
    if (columns[a] < 0) continue;
    const auto J_a = J.middleCols(kStart[a], kSize[a]);
    system.b.segment(columns[a], kSize[a]) += J_a.transpose() * r;
    corner.cross.middleRows(columns[a], kSize[a]) += J_a.transpose() * J_landmark;
    for (std::size_t c = 0; c < 4; ++c) {
      if (columns[c] < 0) continue;
      system.H.block(columns[a], columns[c], kSize[a], kSize[c]) +=
          J_a.transpose() * J.middleCols(kStart[c], kSize[c]);
    }
  }
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
  if (graph.prior() != nullptr) add_factor(*graph.prior(), graph.prior_keys(), graph, layout, system);
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
