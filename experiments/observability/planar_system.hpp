#pragma once

#include <array>
#include <vector>

#include "experiments/observability/dual.hpp"

namespace cosight::experiments {

/// The system of the paper's observability analysis (C9-C13): camera [x z theta vx vz omega] and the inverse
/// depths of four landmarks. Where a landmark was first seen, and in which direction, is known.
struct PlanarSystem {
  static constexpr std::size_t kLandmarks = 4;
  static constexpr std::size_t kX = 0, kZ = 1, kTheta = 2, kVx = 3, kVz = 4, kOmega = 5, kRho = 6;
  static constexpr std::size_t kDim = kRho + kLandmarks;
};

/// Where and in which direction a landmark was first seen; the direction as a unit vector.
template <class Field>
struct Anchor {
  Field x0{}, z0{}, cos_theta{}, sin_theta{};
};

template <class Field>
using StateVector = std::array<Field, PlanarSystem::kDim>;

/// Rows of the observability matrix.
template <class Field>
using ObservabilityMatrix = std::vector<StateVector<Field>>;

/// Gradients of the Lie derivatives of the bearing (C10)
///
///   h = atan2(z_c - z_i, x_c - x_i) - theta_c,   x_i = cos(theta_i) / rho_i + x_0i  (C11),
///
/// along f = [vx vz omega 0 0 0 0 …] up to `order`. With d = (x_c - x_i, z_c - z_i) the bearing's rate along
/// the flow is (d x v) / |d + v t|^2 - omega, and L_k h its Taylor coefficients times (k - 1)!.
template <class Field>
void append_bearing_rows(const StateVector<Field>& x, const Anchor<Field>& anchor, std::size_t landmark,
                         int order, ObservabilityMatrix<Field>& rows) {
  using Number = Dual<Field, PlanarSystem::kDim>;
  const auto state = [&x](std::size_t i) { return Number::variable(x[i], i); };
  const Number rho = state(PlanarSystem::kRho + landmark);
  const Number dx =
      state(PlanarSystem::kX) - (Number::constant(anchor.cos_theta) / rho + Number::constant(anchor.x0));
  const Number dz =
      state(PlanarSystem::kZ) - (Number::constant(anchor.sin_theta) / rho + Number::constant(anchor.z0));
  const Number range2 = dx * dx + dz * dz;

  StateVector<Field> bearing;  // the gradient of an arctangent is rational, and all that is asked for
  for (std::size_t i = 0; i < bearing.size(); ++i)
    bearing[i] = (dx.value * dz.gradient[i] - dz.value * dx.gradient[i]) / range2.value;
  bearing[PlanarSystem::kTheta] = bearing[PlanarSystem::kTheta] - Field{1};
  rows.push_back(bearing);

  const Number vx = state(PlanarSystem::kVx);
  const Number vz = state(PlanarSystem::kVz);
  const Number cross = dx * vz - dz * vx;
  const Number approach = dx * vx + dz * vz;
  const Number speed2 = vx * vx + vz * vz;
  // 1 / (range2 + 2 approach t + speed2 t^2), coefficient by coefficient.
  Number before = Number::constant(Field{0});
  Number coefficient = Number::constant(Field{1}) / range2;
  Number factorial = Number::constant(Field{1});
  for (int k = 1; k <= order; ++k) {
    Number lie = factorial * cross * coefficient;
    if (k == 1) lie = lie - state(PlanarSystem::kOmega);
    rows.push_back(lie.gradient);
    const Number next = Number::constant(Field{0}) -
                        (approach * coefficient + approach * coefficient + speed2 * before) / range2;
    before = coefficient;
    coefficient = next;
    factorial = factorial * Number::constant(static_cast<Field>(static_cast<unsigned>(k)));
  }
}

/// O of C13: zero-order and up to `order` Lie derivatives of four bearings, and the zero-order one of
/// `pseudo_stereo` depths y_i = 1 / rho_i (C12).
template <class Field>
ObservabilityMatrix<Field> observability_matrix(
    const StateVector<Field>& x, const std::array<Anchor<Field>, PlanarSystem::kLandmarks>& anchors,
    int order, std::size_t pseudo_stereo) {
  ObservabilityMatrix<Field> rows;
  for (std::size_t i = 0; i < PlanarSystem::kLandmarks; ++i)
    append_bearing_rows(x, anchors[i], i, order, rows);
  for (std::size_t i = 0; i < pseudo_stereo; ++i) {
    StateVector<Field> depth{};
    const Field rho = x[PlanarSystem::kRho + i];
    depth[PlanarSystem::kRho + i] = Field{0} - Field{1} / (rho * rho);
    rows.push_back(depth);
  }
  return rows;
}

}  // namespace cosight::experiments
