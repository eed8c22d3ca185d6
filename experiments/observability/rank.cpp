#include "experiments/observability/rank.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace cosight::experiments {
namespace {

template <class Field>
struct Setup {
  StateVector<Field> x{};
  std::array<Anchor<Field>, PlanarSystem::kLandmarks> anchors{};
};

template <class Field>
void apply(const ObservabilityCase& chosen, Setup<Field>& setup) {
  if (chosen.common_anchor) {
    for (Anchor<Field>& anchor : setup.anchors) {
      anchor.x0 = setup.anchors.front().x0;
      anchor.z0 = setup.anchors.front().z0;
    }
  }
  if (chosen.at_rest) setup.x[PlanarSystem::kVx] = setup.x[PlanarSystem::kVz] = Field{0};
}

/// Anything in the field; directions on the unit circle by its rational parametrisation.
Setup<PrimeField> random_exact(const ObservabilityCase& chosen, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  Setup<PrimeField> setup;
  for (PrimeField& value : setup.x)
    value = PrimeField{rng()};
  for (Anchor<PrimeField>& anchor : setup.anchors) {
    const PrimeField t{rng()};
    const PrimeField one{1};
    anchor = {PrimeField{rng()}, PrimeField{rng()}, (one - t * t) / (one + t * t), (t + t) / (one + t * t)};
  }
  apply(chosen, setup);
  return setup;
}

/// A camera that walks by a wall; anchors behind it on its way.
Setup<double> random_metric(const ObservabilityCase& chosen, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Setup<double> setup;
  setup.x = {2.0 * unit(rng), 0.5 * unit(rng), 3.0 * unit(rng), 0.3 + 0.7 * std::abs(unit(rng)),
             0.3 * unit(rng), 0.3 * unit(rng)};
  for (std::size_t i = 0; i < PlanarSystem::kLandmarks; ++i) {
    setup.x[PlanarSystem::kRho + i] = 1.0 / (4.0 + 2.0 * unit(rng));
    const double theta = 1.5708 + 0.6 * unit(rng);
    setup.anchors.at(i) = {-3.0 + unit(rng), 0.5 * unit(rng), std::cos(theta), std::sin(theta)};
  }
  apply(chosen, setup);
  return setup;
}

}  // namespace

int rank_of(ObservabilityMatrix<PrimeField> rows) {
  std::size_t rank = 0;
  for (std::size_t column = 0; column < PlanarSystem::kDim && rank < rows.size(); ++column) {
    const auto pivot = std::find_if(rows.begin() + static_cast<std::ptrdiff_t>(rank), rows.end(),
                                    [column](const auto& row) { return !row[column].is_zero(); });
    if (pivot == rows.end()) continue;
    std::swap(rows[rank], *pivot);
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const PrimeField factor = rows[r][column] / rows[rank][column];
      for (std::size_t c = column; c < PlanarSystem::kDim; ++c)
        rows[r][c] = rows[r][c] - factor * rows[rank][c];
    }
    ++rank;
  }
  return static_cast<int>(rank);
}

int symbolic_rank(const ObservabilityCase& setup, std::uint64_t seed) {
  const auto drawn = random_exact(setup, seed);
  return rank_of(observability_matrix(drawn.x, drawn.anchors, setup.order, setup.pseudo_stereo));
}

bool scale_is_unobservable(const ObservabilityCase& setup, std::uint64_t seed) {
  const auto drawn = random_exact(setup, seed);
  StateVector<PrimeField> direction = drawn.x;
  direction[PlanarSystem::kX] = direction[PlanarSystem::kX] - drawn.anchors.front().x0;
  direction[PlanarSystem::kZ] = direction[PlanarSystem::kZ] - drawn.anchors.front().z0;
  direction[PlanarSystem::kTheta] = direction[PlanarSystem::kOmega] = PrimeField{0};
  for (std::size_t i = PlanarSystem::kRho; i < direction.size(); ++i)
    direction[i] = PrimeField{0} - direction[i];
  const auto rows = observability_matrix(drawn.x, drawn.anchors, setup.order, setup.pseudo_stereo);
  return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
    PrimeField product{0};
    for (std::size_t i = 0; i < row.size(); ++i)
      product = product + row[i] * direction[i];
    return product.is_zero();
  });
}

Eigen::VectorXd singular_values(const ObservabilityCase& setup, std::uint64_t seed) {
  const auto drawn = random_metric(setup, seed);
  const auto rows = observability_matrix(drawn.x, drawn.anchors, setup.order, setup.pseudo_stereo);
  Eigen::MatrixXd O = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), PlanarSystem::kDim);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    O.row(static_cast<Eigen::Index>(r)) =
        Eigen::Map<const Eigen::RowVectorXd>(rows[r].data(), PlanarSystem::kDim).normalized();
  }
  Eigen::VectorXd values = Eigen::VectorXd::Zero(PlanarSystem::kDim);
  const Eigen::VectorXd found = Eigen::JacobiSVD<Eigen::MatrixXd>(O).singularValues();
  values.head(found.size()) = found;
  return values;
}

int numeric_rank(const Eigen::VectorXd& singular_values) {
  constexpr double kZero = 1e-9;
  return static_cast<int>((singular_values.array() > kZero * singular_values(0)).count());
}

}  // namespace cosight::experiments
