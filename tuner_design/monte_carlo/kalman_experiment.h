#pragma once
// The monitor's own filter, flown cold on many engines with constant health, beside the theory of the same window.
//
//   engine i   h ~ N(0, Ph), in balance with constant u, which the filter knows;
//              y[k] = y(h) + c dx[k] + v[k],  dx[k+1] = A dx[k] + w[k],  dx[0] = 0;
//              w = 0 unless process noise is asked for (linear truth only)
//   error      of h and z, squared, averaged over the window, then over the engines
//   coverage   share of the window's samples with |error| <= 1.96 sigma_total, as the monitor publishes it at that
//              sample (monitor/estimation/error_propagation.h)
// Engine i draws from the stream (seed, i). One number per engine: its standard error needs no model of how the samples
// of a run hang together.

#include "tuner_design/monte_carlo/evaluation.h"
#include "tuner_design/monte_carlo/finite_window.h"
#include "tuner_design/monte_carlo/truth.h"

namespace ehm::bench {

struct KalmanOptions {
  std::size_t runs = 375;
  Window window;
  std::uint64_t seed = 1;
  unsigned threads = 1;
  bool process_noise = false;
};

/// `done` is called with the number of runs that are done.
/// @throws std::invalid_argument if process noise is asked for on a nonlinear truth.
/// @throws std::runtime_error if more than one engine in a hundred has no steady point.
Experiment kalman_experiment(const design::Design& design, const Truth& truth, const KalmanOptions& options,
                             const std::function<void(std::size_t)>& done);

}  // namespace ehm::bench
