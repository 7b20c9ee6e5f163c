// SPDX-License-Identifier: Apache-2.0
#pragma once
// The linear model as the filters on all n + p states use it: state [x; h] with constant or slowly fading h,
//
//   x[k+1] = A x + B u + L h + w      y = [C M] [x; h] + D u + v      z = [F N] [x; h] + G u
//
// (linear_model.h; theory.md, section 8). Discrete time, deviations from trim. The units are those of the LinearModel
// it is made of; covariances are well conditioned in scaled units (scaling.h). Fixed capacity.

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/capacity.h"

namespace ehm::estimation {

using FullOrderCovariance = BoundedMatrix<max_augmented, max_augmented>;
static_assert(max_states + max_health <= max_augmented);

/// What the real engine's nonlinearity adds to sensors and outputs has as many directions at most.
inline constexpr int max_offsets = max_sensors + max_auxiliary;

struct FullOrderModel {
  BoundedMatrix<max_states, max_states> A;
  BoundedMatrix<max_states, max_actuators> B;
  BoundedMatrix<max_states, max_health> L;
  BoundedMatrix<max_sensors, max_augmented> sensor_output;  ///< [C M]
  BoundedMatrix<max_sensors, max_actuators> D;
  BoundedMatrix<max_auxiliary, max_augmented> auxiliary_output;  ///< [F N]
  BoundedMatrix<max_auxiliary, max_actuators> G;
  BoundedMatrix<max_states, max_states> process_noise;  ///< Q, per sample
  SensorVector sensor_noise_variance;                   ///< diagonal of R
  /// Of an engine of the fleet that has run before the filter looks at it: [X; I] Ph [X; I]^T + blkdiag(cov(dx), 0),
  /// X = (I-A)^-1 L, and its motion about the balance, cov(dx) = A cov(dx) A^T + Q.
  FullOrderCovariance prior;
  /// [Ey; Ez], a root of the model's linearisation_error; without columns where the model has none.
  BoundedMatrix<max_sensors, max_offsets> sensor_offset;
  BoundedMatrix<max_auxiliary, max_offsets> auxiliary_offset;
};

/// `model` has passed linear_model::check_model.
/// @throws std::invalid_argument if it is continuous or exceeds the capacity (says which list).
/// @throws std::runtime_error if I - A is singular or A not stable.
FullOrderModel full_order_model(const linear_model::LinearModel& model);

}  // namespace ehm::estimation
