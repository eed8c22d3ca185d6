#pragma once

#include "robot_agent/vins/factor_graph.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

struct SolverOptions {
  int max_iterations = 5;  ///< a bound on the time of one frame; more when frames are rare
  GraphOptions graph;
};

struct SolveReport {
  bool usable = false;  ///< false: the window was left as it was
  int iterations = 0;
  int visual_terms = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
};

/// Minimises V20 / V31 over all states of the window and writes them back.
SolveReport solve(Window& window, const SolverOptions& options);

}  // namespace cosight::vins
