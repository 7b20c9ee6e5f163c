// SPDX-License-Identifier: Apache-2.0
#pragma once
// A design against its theory: the same estimators, flown over many engines, beside what theory says of the very same
// window from the very same start. Truths (truth.h): the design's linear model, or the nonlinear engine at its
// operating point. Estimators: the monitor's own filter (kalman_experiment.h) and MAP on one noisy snapshot
// (map_experiment.h).
//
// Squared errors are health in percent^2 and auxiliary outputs in reporting units^2
// (engine_sim/linear_model/scaling.h), as in design::Design. The independent unit is the engine: standard error =
// standard deviation over engines / sqrt(n). The same seed gives the same bytes on any number of threads.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "deploy/runtime/long_work/parallel_for.h"
#include "engine_sim/engines/jt9d_engine.h"
#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// What the nonlinear truth's control holds at the design's trim (truth.h).
enum class Hold { fan_speed, fuel_flow };

struct EvaluateOptions {
  bool linear = true, nonlinear = false;                                                      ///< truths
  std::shared_ptr<const engine_sim::EngineDefinition> engine = engine_sim::default_engine();  ///< of the nonlinear one
  bool kalman = true, map = true;                                                             ///< estimators
  std::size_t runs = 375;        ///< engines that the filter flies on, [SG]'s number
  std::size_t engines = 100000;  ///< engines of the MAP estimators
  double seconds = 30.0;         ///< of a run, from a cold start
  double window = 10.0;          ///< the last seconds of it, over which the error is averaged
  std::uint64_t seed = 1;
  unsigned threads = long_work::all_cores();
  Hold hold = Hold::fan_speed;
  double wear = 1.0;          ///< the engines' health is drawn so many times wider than the fleet's
  bool process_noise = true;  ///< the Kalman filter's engine moves by the model's w; without it it is in balance
};

/// Sums of the squared errors over channels (SSEE).
struct ErrorTotals {
  double health = 0.0, auxiliary = 0.0;
};

/// One estimator on one truth.
struct Experiment {
  std::string estimator;                 ///< "Kalman filter", "MAP, full order", "MAP, on the tuners"
  std::string truth;                     ///< one line: which engine, what noise, what is held
  bool nonlinear = false;                ///< the truth
  std::size_t engines = 0;               ///< flown
  std::size_t without_steady_point = 0;  ///< drawn, but the engine does not run with that health: left out
  design::ErrorByChannel theory;         ///< of the linear engine, same window and start, same process noise
  design::ErrorByChannel linearisation;  ///< added by the truth's nonlinearity as the design has it; linear truth: 0
  design::ErrorByChannel settled;        ///< theory of the linear engine after endless time
  design::ErrorByChannel experiment, standard_error;
  ErrorTotals standard_error_of_total;  ///< of the experiment's SSEE
  /// Share of the time within the published +-1.96 sigma_total, and its standard error; empty for MAP.
  design::ErrorByChannel coverage, coverage_standard_error;

  double theory_health() const { return theory.health.sum() + linearisation.health.sum(); }
  double theory_auxiliary() const { return theory.auxiliary.sum() + linearisation.auxiliary.sum(); }
};

struct Evaluation {
  std::vector<Experiment> experiments;  ///< linear before nonlinear, the Kalman filter before MAP
};

/// Called often, by the calling thread, with the share of the work that is done, 0 to 1.
using EvaluateProgress = std::function<void(double)>;

/// @throws std::invalid_argument if an option is out of its range, or does not fit the design (a foreign
///         engine on the nonlinear truth); the message names it and what is allowed.
/// @throws std::runtime_error if more than one engine in a hundred has no steady point.
Evaluation evaluate(
    const design::Design& design, const EvaluateOptions& options, const EvaluateProgress& progress = [](double) {});

}  // namespace ehm::tuner_design
