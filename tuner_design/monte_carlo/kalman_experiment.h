// SPDX-License-Identifier: Apache-2.0
#pragma once
// The monitor's own filter, flown cold on many engines with constant health, beside the theory of the same window.
//
//   engine i   h ~ N(0, wear^2 Ph), constant u, which the filter knows; it moves by dx about its balance y(h), z(h):
//              y[k] = y(h) + C dx[k] + v[k],   z[k] = z(h) + F dx[k],   dx[k+1] = A dx[k] + w[k],   cov(w) = Q
//              dx is stationary from the first sample on, or 0 without process noise. The nonlinear engine's motion is
//              that of the design's linear model too: it is small against the fleet's spread
//   error      of h and z, squared, averaged over the window, then over the engines
//   coverage   share of the window's samples with |error| <= 1.96 sigma_total, as the monitor publishes it at that
//              sample, wider for an engine far outside the fleet (monitor/estimation/error_propagation.h,
//              monitor/diagnosis/fleet_watch.h); what the monitor would withhold counts as well
// Engine i draws from the stream (seed, i). One number per engine: its standard error needs no model of how the samples
// of a run hang together.

#include "tuner_design/monte_carlo/evaluation.h"
#include "tuner_design/monte_carlo/finite_window.h"
#include "tuner_design/monte_carlo/truth.h"

namespace ehm::tuner_design {

struct KalmanOptions {
  std::size_t runs = 375;
  Window window;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool process_noise = true;
  double wear = 1.0;
};

/// `done` is called with the number of runs that are done.
/// @throws std::runtime_error if more than one engine in a hundred has no steady point.
Experiment kalman_experiment(const design::Design& design, const Truth& truth, const KalmanOptions& options,
                             const std::function<void(std::size_t)>& done);

}  // namespace ehm::tuner_design
