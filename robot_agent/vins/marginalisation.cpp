#include "robot_agent/vins/marginalisation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cosight::vins {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
template <int kRows, int kCols>
using RowMajor = Eigen::Matrix<double, kRows, kCols, Eigen::RowMajor>;

/// Where each state stands in the normal equations: those to go first, then those to stay.
class Layout {
 public:
  Layout(std::vector<StateKey> keys, const auto& goes) {
    std::stable_partition(keys.begin(), keys.end(), goes);
    for (const StateKey& key : keys) {
      places_.push_back({key, size_});
      size_ += tangent_size(key.kind);
      if (goes(key)) gone_ = size_;
    }
  }

  /// Column of a state, or -1 when it is a constant.
  Index column(StateKey key) const {
    const auto place =
        std::find_if(places_.begin(), places_.end(), [&](const Place& p) { return p.key == key; });
    return place == places_.end() ? -1 : place->column;
  }
  Index size() const { return size_; }
  Index gone() const { return gone_; }

  std::vector<StateKey> kept() const {
    std::vector<StateKey> keys;
    for (const Place& place : places_) {
      if (place.column >= gone_) keys.push_back(place.key);
    }
    return keys;
  }

 private:
  struct Place {
    StateKey key;
    Index column;
  };
  std::vector<Place> places_;
  Index size_ = 0;
  Index gone_ = 0;
};

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
                const Layout& layout, NormalEquations& system) {
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

/// A landmark's own corner of the normal equations, to be taken out at once: it is a single number.
struct LandmarkCorner {
  double H = 0.0;
  double b = 0.0;
  VectorXd cross;  ///< with every state

  explicit LandmarkCorner(Index size) : cross(VectorXd::Zero(size)) {}

  void eliminate(NormalEquations& system) {
    constexpr double kMinInformation = 1e-12;
    if (H > kMinInformation) {
      system.H.noalias() -= cross * cross.transpose() / H;
      system.b.noalias() -= cross * (b / H);
    }
    H = b = 0.0;
    cross.setZero();
  }
};

void add_visual(const FactorGraph::VisualTerm& term, FactorGraph& graph, const Layout& layout,
                NormalEquations& system, LandmarkCorner& corner) {
  const auto blocks = graph.blocks(term);
  const auto poses = graph.pose_keys(term);
  const std::array<Index, 4> columns{layout.column(poses[0]), layout.column(poses[1]),
                                     layout.column({StateKind::kExtrinsics, 0}),
                                     layout.column({StateKind::kTimeOffset, 0})};
  std::array<RowMajor<2, 7>, 3> J_pose;
  Eigen::Vector2d r;
  Eigen::Vector2d J_lambda;
  Eigen::Vector2d J_offset;
  std::array<double*, 5> jacobians{J_pose[0].data(), J_pose[1].data(), J_pose[2].data(), J_lambda.data(),
                                   J_offset.data()};
  term.factor.Evaluate(blocks.data(), r.data(), jacobians.data());
  double root = 1.0;
  if (term.loss != nullptr) {
    std::array<double, 3> rho{};
    term.loss->Evaluate(r.squaredNorm(), rho.data());
    root = std::sqrt(rho[1]);
  }
  Eigen::Matrix<double, 2, 19> J;
  J << J_pose[0].leftCols<6>(), J_pose[1].leftCols<6>(), J_pose[2].leftCols<6>(), J_offset;
  J *= root;
  r *= root;
  J_lambda *= root;
  corner.H += J_lambda.squaredNorm();
  corner.b += J_lambda.dot(r);
  constexpr std::array<Index, 4> kStart{0, 6, 12, 18};
  constexpr std::array<Index, 4> kSize{6, 6, 6, 1};
  for (std::size_t a = 0; a < 4; ++a) {
    if (columns[a] < 0) continue;
    const auto J_a = J.middleCols(kStart[a], kSize[a]);
    system.b.segment(columns[a], kSize[a]) += J_a.transpose() * r;
    corner.cross.segment(columns[a], kSize[a]) += J_a.transpose() * J_lambda;
    for (std::size_t c = 0; c < 4; ++c) {
      if (columns[c] < 0) continue;
      system.H.block(columns[a], columns[c], kSize[a], kSize[c]) +=
          J_a.transpose() * J.middleCols(kStart[c], kSize[c]);
    }
  }
}

NormalEquations linearise(FactorGraph& graph, const Layout& layout) {
  NormalEquations system{MatrixXd::Zero(layout.size(), layout.size()), VectorXd::Zero(layout.size())};
  LandmarkCorner corner(layout.size());
  std::size_t landmark = 0;
  for (const auto& term : graph.visual_terms()) {
    if (term.landmark != landmark) corner.eliminate(system);
    landmark = term.landmark;
    add_visual(term, graph, layout, system, corner);
  }
  corner.eliminate(system);
  for (const auto& term : graph.imu_terms()) {
    const auto keys = graph.keys(term);
    add_factor(term.factor, {keys.begin(), keys.end()}, graph, layout, system);
  }
  if (graph.prior() != nullptr) add_factor(*graph.prior(), graph.prior_keys(), graph, layout, system);
  return system;
}

Prior to_prior(const NormalEquations& system, const std::vector<StateKey>& keys, FactorGraph& graph) {
  Prior prior;
  for (const StateKey& key : keys) {
    prior.blocks.push_back({key, Eigen::Map<const VectorXd>(graph.block(key), ambient_size(key.kind))});
  }
  SquareRoot root = square_root(system);
  prior.J = std::move(root.J);
  prior.residual = std::move(root.r);
  return prior;
}

}  // namespace

NormalEquations schur_complement(const NormalEquations& system, Index count) {
  const Index rest = system.H.rows() - count;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> corner(system.H.topLeftCorner(count, count));
  const VectorXd& values = corner.eigenvalues();
  const double smallest = 1e-14 * std::max(values.maxCoeff(), 1.0);
  const VectorXd inverse = (values.array() > smallest).select(values.cwiseInverse(), 0.0);
  const MatrixXd half = inverse.cwiseSqrt().asDiagonal() * corner.eigenvectors().transpose();
  const MatrixXd coupling = half * system.H.topRightCorner(count, rest);
  NormalEquations out{system.H.bottomRightCorner(rest, rest), system.b.tail(rest)};
  out.H.noalias() -= coupling.transpose() * coupling;
  out.b.noalias() -= coupling.transpose() * (half * system.b.head(count));
  return out;
}

SquareRoot square_root(const NormalEquations& system) {
  // Units differ by many powers of ten: scaled to a unit diagonal, one threshold tells rank from rounding.
  const VectorXd scale = (system.H.diagonal().array() > 0.0)
                             .select(system.H.diagonal().cwiseSqrt(), VectorXd::Ones(system.b.size()));
  const VectorXd unscale = scale.cwiseInverse();
  const Eigen::LDLT<MatrixXd> ldlt(unscale.asDiagonal() * system.H * unscale.asDiagonal());
  constexpr double kRankThreshold = 1e-12;
  const VectorXd D = (ldlt.vectorD().array() > kRankThreshold).select(ldlt.vectorD(), 0.0);
  const VectorXd root_D = D.cwiseSqrt();
  const VectorXd inverse_root_D = (D.array() > 0.0).select(root_D.cwiseInverse(), 0.0);
  const MatrixXd L_T_P =
      ldlt.matrixU() * MatrixXd(ldlt.transpositionsP() * MatrixXd::Identity(D.size(), D.size()));
  VectorXd r = ldlt.transpositionsP() * (unscale.asDiagonal() * system.b);
  ldlt.matrixL().solveInPlace(r);
  return {root_D.asDiagonal() * L_T_P * scale.asDiagonal(), inverse_root_D.asDiagonal() * r};
}

Prior marginalise_oldest(const Window& window, const GraphOptions& options) {
  FactorGraph graph(window, options, GraphScope::kOldestFrame);
  const FrameId oldest = window.frames.front().id;
  const auto goes = [oldest](const StateKey& key) {
    return key.frame == oldest && (key.kind == StateKind::kPose || key.kind == StateKind::kMotion);
  };
  const Layout layout(graph.free_states(), goes);
  const NormalEquations system = schur_complement(linearise(graph, layout), layout.gone());
  return to_prior(system, layout.kept(), graph);
}

Prior marginalise_frame(const Window& window, const GraphOptions& options, FrameId frame) {
  const auto goes = [frame](const StateKey& key) {
    return key.frame == frame && (key.kind == StateKind::kPose || key.kind == StateKind::kMotion);
  };
  FactorGraph graph(window, options, GraphScope::kPrior);
  const Layout layout(graph.prior_keys(), goes);
  if (layout.gone() == 0) return window.prior;
  return to_prior(schur_complement(linearise(graph, layout), layout.gone()), layout.kept(), graph);
}

}  // namespace cosight::vins
