#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "experiments/observability/planar_system.hpp"
#include "experiments/observability/prime_field.hpp"

namespace cosight::experiments {

/// One way to set the system up.
struct ObservabilityCase {
  std::size_t pseudo_stereo = 0;  ///< landmarks whose depth is measured
  int order = 1;                  ///< of the Lie derivatives of a bearing; the paper's is 1
  bool common_anchor = false;     ///< all landmarks were first seen from one place
  bool at_rest = false;           ///< the camera stands still
};

/// Rank of the observability matrix at a random state, over the prime field: the symbolic rank.
int symbolic_rank(const ObservabilityCase& setup, std::uint64_t seed);

/// Is a change of scale about the common anchor,
/// [x - x0, z - z0, 0, vx, vz, 0, -rho_i], in the kernel of the matrix? Exact, at a random state.
bool scale_is_unobservable(const ObservabilityCase& setup, std::uint64_t seed);

/// Singular values of the same matrix in floating point at a random state of a room (metres, m/s), rows
/// normalised, largest first, as many as states; the second opinion.
Eigen::VectorXd singular_values(const ObservabilityCase& setup, std::uint64_t seed);

/// Their number above 1e-9 of the largest.
int numeric_rank(const Eigen::VectorXd& singular_values);

/// Rank by elimination; exact. Takes the matrix apart.
int rank_of(ObservabilityMatrix<PrimeField> rows);

}  // namespace cosight::experiments
