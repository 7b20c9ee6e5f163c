// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the snapshot estimators know of an engine of the fleet. For them it stands in balance but for its own motion and
// for what its actuators do to it, which the linear model tells and which is taken out of every sample:
//
//   xu[0] = (I-A)^-1 B u[0],   xu[k+1] = A xu[k] + B u[k]            response to known controls, n
//   e = R^-1/2 (y - D u - C xu)  =  Hn h + En o + Cn dx + v          the rest of a sample, in sigmas of its noise, m
//   z - F xu - G u               =  Hz h + Ez o + F dx               the rest of the outputs, r
//
//   h   p, health in sigmas of the fleet, unit variance:  Hn = R^-1/2 (C X + M) Ph^1/2,  Hz = (F X + N) Ph^1/2,
//       X = (I-A)^-1 L
//   o   l, what the linear model misses of the real engine, unit variance and constant:  [R^1/2 En; Ez] is a root of
//       Lambda, the model's linearisation_error; l = 0 where the model knows of none
//   dx  n, the engine's own motion about its balance:  dx[k+1] = A dx[k] + w,  cov(dx) = A cov(dx) A^T + Q;
//       Cn = R^-1/2 C
//   v   m, noise of the sensors, unit variance
//
// y, u deviations from trim, scaled units (scaling.h). Source: Simon & Garg, NASA/TM-2010-216077, eq. 9 ff.; theory.md,
// sections 1, 3, 4.

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/full_order_model.h"

namespace ehm::estimation {

struct SnapshotModel {
  BoundedMatrix<max_states, max_states> A;
  BoundedMatrix<max_states, max_actuators> B;
  BoundedMatrix<max_states, max_actuators> balance;        ///< (I-A)^-1 B
  BoundedMatrix<max_sensors, max_actuators> actuator_out;  ///< R^-1/2 D
  BoundedMatrix<max_auxiliary, max_actuators> G;
  BoundedMatrix<max_sensors, max_health> health_signal;   ///< Hn
  BoundedMatrix<max_sensors, max_offsets> offset_signal;  ///< En
  BoundedMatrix<max_sensors, max_states> state_signal;    ///< Cn
  BoundedMatrix<max_auxiliary, max_health> health_output;
  BoundedMatrix<max_auxiliary, max_offsets> offset_output;
  BoundedMatrix<max_auxiliary, max_states> state_output;
  BoundedMatrix<max_states, max_states> motion;  ///< cov(dx)
  SensorVector noise_sigma;                      ///< diagonal of R^1/2, scaled units
  HealthVector health_sigma;                     ///< diagonal of Ph^1/2, scaled units

  Eigen::Index states() const noexcept { return A.rows(); }
  Eigen::Index sensors() const noexcept { return health_signal.rows(); }
  Eigen::Index health() const noexcept { return health_signal.cols(); }
  Eigen::Index offsets() const noexcept { return offset_signal.cols(); }
};

/// `model` has passed linear_model::check_model; discrete, scaled.
/// @throws as full_order_model().
SnapshotModel snapshot_model(const linear_model::LinearModel& model);

}  // namespace ehm::estimation
