// SPDX-License-Identifier: Apache-2.0
#pragma once
// The limit for N samples: expected squared error of the time-varying full-order Kalman filter, by channel, after it
// has seen N samples of one settled engine of the fleet (monitor/estimation/time_varying_filter.h, which is what runs
// here). No linear estimator is better on these samples. Without process noise it is, in closed form, the full MAP
// estimator on the average of N samples:
//   cov(h) = Ph - Ph H^T (H Ph H^T + R/N)^-1 H Ph                        N = 1: full MAP,  N -> infinity: Bayes limit
// A moving engine, or one with process noise, has no such form; the recursion covers them.

#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// `model` is discrete and scaled; the truth has its process noise, in motion before the first sample, and no
/// linearisation error. The squared errors are those after N samples, averaged over the last `window` of them: the
/// quantity of a Monte Carlo that averages over the end of a run. Needs 1 <= window <= samples.
/// @throws std::invalid_argument if the numbers of samples are wrong or the model exceeds the filter's capacity.
design::ErrorByChannel limit_after(const linear_model::LinearModel& model, int samples, int window = 1);

}  // namespace ehm::tuner_design
