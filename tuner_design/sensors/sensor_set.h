// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a set of sensors is worth: the published error of the filter that would fly with it.
//
// The Kalman filter that `design` makes of these sensors alone at the given Qh with the closed form V_S = H_S Ph
// (closed_form_filter), with as many tuners. Error: the totals of kalman_error.h, the linearisation error included
// where the model knows it. Figure of merit: J of relative_error.h with the limits of ALL candidates, so that every
// set is measured with the same yardstick.
// Candidates may be more than a design can hold: 20. A set is a bit mask, bit i for sensor i of the model.

#include <cstdint>
#include <optional>

#include "tuner_design/theory/relative_error.h"

namespace ehm::tuner_design {

using CandidateSet = std::uint32_t;
inline constexpr int max_candidates = 20;

struct SensorProblem {
  linear_model::LinearModel model;  ///< discrete, scaled, with every candidate
  estimation::SteadyGain steady;
  RelativeError merit;
  design::ErrorWeights weights;
  double qh_percent2 = 0.0;

  [[nodiscard]] CandidateSet every() const { return (CandidateSet{1} << model.sensors.size()) - 1; }
};

struct SensorSetValue {
  int tuners = 0;
  design::ErrorByChannel error;
  double merit = 0.0;  ///< J
  double slowest_time_constant_s = 0.0;
};

/// `model` has passed linear_model::check_model, but may have up to 20 sensors.
/// @throws std::invalid_argument if it has more; std::runtime_error if it has no steady state; what
///         make_point_problem throws of the weights.
SensorProblem sensor_problem(const linear_model::LinearModel& model, double qh_percent2,
                             const design::ErrorWeights& weights = {});

/// J of the fleet itself, without any sensor.
double fleet_merit(const SensorProblem& problem);

/// nullopt if no filter on these sensors keeps every sigma within the fleet's own: they are worth nothing.
std::optional<SensorSetValue> value_of(const SensorProblem& problem, CandidateSet set);

}  // namespace ehm::tuner_design
