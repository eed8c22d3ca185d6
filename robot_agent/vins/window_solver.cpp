#include "robot_agent/vins/window_solver.hpp"

#include <ceres/ceres.h>

namespace cosight::vins {
namespace {

/// Everything that a Ceres problem points to is owned by the graph.
ceres::Problem::Options borrowed() {
  ceres::Problem::Options options;
  options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;
  return options;
}

/// Ceres takes factors as mutable; ours are not changed by evaluation.
ceres::CostFunction* lent(const ceres::CostFunction& factor) {
  return const_cast<ceres::CostFunction*>(&factor);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
}

void add_states(FactorGraph& graph, const Window& window, PoseManifold& manifold, ceres::Problem& problem) {
  for (const WindowFrame& frame : window.frames) {
    problem.AddParameterBlock(graph.block({StateKind::kPose, frame.id}), 7, &manifold);
    problem.AddParameterBlock(graph.block({StateKind::kMotion, frame.id}), 9);
  }
  double* extrinsics = graph.block({StateKind::kExtrinsics, 0});
  double* time_offset = graph.block({StateKind::kTimeOffset, 0});
  problem.AddParameterBlock(extrinsics, 7, &manifold);
  problem.AddParameterBlock(time_offset, 1);
  if (graph.is_constant(StateKind::kExtrinsics)) problem.SetParameterBlockConstant(extrinsics);
  if (graph.is_constant(StateKind::kTimeOffset)) problem.SetParameterBlockConstant(time_offset);
}

void add_factors(FactorGraph& graph, ceres::Problem& problem) {
  for (const auto& term : graph.visual_terms()) {
    const auto blocks = graph.blocks(term);
    problem.AddResidualBlock(lent(term.factor), const_cast<ceres::LossFunction*>(term.loss), blocks.data(),
                             static_cast<int>(blocks.size()));
  }
  for (std::size_t l = 0; l < graph.landmark_count(); ++l) {
    const auto& term = graph.host_term(l);
    problem.AddResidualBlock(lent(term.factor), const_cast<ceres::LossFunction*>(term.loss),
                             graph.landmark(l));
    if (!term.distance) continue;
    problem.AddResidualBlock(lent(*term.distance), const_cast<ceres::LossFunction*>(term.distance_loss),
                             graph.landmark(l));
  }
  for (const auto& term : graph.imu_terms()) {
    std::array<double*, 4> blocks{};
    const auto keys = graph.keys(term);
    for (std::size_t i = 0; i < keys.size(); ++i)
      blocks[i] = graph.block(keys[i]);
    problem.AddResidualBlock(lent(term.factor), nullptr, blocks.data(), static_cast<int>(blocks.size()));
  }
  if (graph.prior() != nullptr) {
    std::vector<double*> blocks;
    for (const StateKey& key : graph.prior_keys())
      blocks.push_back(graph.block(key));
    problem.AddResidualBlock(lent(*graph.prior()), nullptr, blocks);
  }
}

/// Landmarks first: each couples with states only, so their block is diagonal.
std::shared_ptr<ceres::ParameterBlockOrdering> ordering(FactorGraph& graph, const Window& window) {
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  for (std::size_t l = 0; l < graph.landmark_count(); ++l)
    order->AddElementToGroup(graph.landmark(l), 0);
  for (const WindowFrame& frame : window.frames) {
    order->AddElementToGroup(graph.block({StateKind::kPose, frame.id}), 1);
    order->AddElementToGroup(graph.block({StateKind::kMotion, frame.id}), 1);
  }
  order->AddElementToGroup(graph.block({StateKind::kExtrinsics, 0}), 1);
  order->AddElementToGroup(graph.block({StateKind::kTimeOffset, 0}), 1);
  return order;
}

ceres::Solver::Options solver_options(const SolverOptions& options) {
  ceres::Solver::Options out;
  out.linear_solver_type = ceres::DENSE_SCHUR;
  out.trust_region_strategy_type = ceres::DOGLEG;
  out.max_num_iterations = options.max_iterations;
  out.num_threads = 1;
  out.logging_type = ceres::SILENT;
  return out;
}

}  // namespace

SolveReport solve(Window& window, const SolverOptions& options) {
  FactorGraph graph(window, options.graph, GraphScope::kWhole);
  PoseManifold manifold;
  ceres::Problem problem(borrowed());
  add_states(graph, window, manifold, problem);
  add_factors(graph, problem);

  ceres::Solver::Options how = solver_options(options);
  if (graph.landmark_count() > 0) how.linear_solver_ordering = ordering(graph, window);
  ceres::Solver::Summary summary;
  ceres::Solve(how, &problem, &summary);

  SolveReport report;
  report.usable = summary.IsSolutionUsable();
  report.iterations = summary.num_successful_steps + summary.num_unsuccessful_steps;
  report.visual_terms = static_cast<int>(graph.visual_terms().size());
  report.initial_cost = summary.initial_cost;
  report.final_cost = summary.final_cost;
  if (report.usable) graph.write_back(window);
  return report;
}

}  // namespace cosight::vins
