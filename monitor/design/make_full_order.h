// SPDX-License-Identifier: Apache-2.0
#pragma once
// From a design's linear model to the estimators on all n + p states. They use its model, noise and scaling, and none
// of its tuners.

#include <memory>

#include "monitor/design/design.h"
#include "monitor/estimation/gauss_markov_estimator.h"
#include "monitor/estimation/time_varying_estimator.h"

namespace ehm::design {

/// Its memory is `memory_s`; one set of all sensors, and one without each, where the Riccati equation has a solution.
/// @throws std::invalid_argument if the model exceeds the capacity; estimation::SolverError if there is no filter with
/// all sensors.
std::shared_ptr<const estimation::GaussMarkovModel> make_gauss_markov_model(const Design& design, double memory_s);

/// @throws std::invalid_argument as make_gauss_markov_model; std::runtime_error if I - A is singular or A not stable.
std::shared_ptr<const estimation::TimeVaryingModel> make_time_varying_model(const Design& design);

}  // namespace ehm::design
