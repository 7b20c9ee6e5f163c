// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an estimator goes on from between two samples: for a checkpoint, and for a successor of the same design. One
// form for all of them, scaled units, plain data of fixed capacity.
//
//   tuner          [x; q] of the set in use    M, S of error_propagation.h
//   gauss_markov   [x; h]                      M, S of the set in use
//   time_varying   [x; h]                      D and P of time_varying_filter.h in the places of M and S
//   map, wls, rls  [xu; hhat]                  [0; Bh Bo] and cov([dx; eps]) of snapshot/snapshot_error.h there
//   onboard        none: what the flight has taught so far (learned.h), from which it begins anew, its speeds measured
//                  and its metal's temperatures in doubt, as after any start in flight
//
//   constrained    that of the one inside, and the constraint's own beside it
//
// M and D are the same: E[xhat - [x; h] | what is unknown but constant]; so is [0; Bh Bo], in sigmas of the fleet. Not
// kept, since the next sample brings it: the innovations, the actuators, what widen() was told.

#include <cstdint>

#include "monitor/estimation/capacity.h"
#include "monitor/estimation/error_propagation.h"
#include "monitor/estimation/learned.h"

namespace ehm::estimation {

/// Of constrained/constrained_estimator.h; p each, all of length 0 where nothing is constrained yet.
struct ConstrainedState {
  HealthVector bound, health;  ///< where each parameter may not go beyond; the constrained estimate; channel units
  HealthVector sigma_share;    ///< of the estimator's own sigma
};

struct EstimatorState {
  int missing_sensor = -1;        ///< that the design in use lacks; -1: none
  std::int64_t held_samples = 0;  ///< since the error's theory went on, while a sensor holds its values
  AugmentedVector estimate = {};
  ErrorState error = {};
  ConstrainedState constrained = {};
  Learned learned = {};  ///< of length 0 where the estimator keeps a state in its place
};

}  // namespace ehm::estimation
