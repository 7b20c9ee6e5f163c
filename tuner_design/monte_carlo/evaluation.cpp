// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/evaluation.h"

#include <stdexcept>

#include "tuner_design/monte_carlo/kalman_experiment.h"
#include "tuner_design/monte_carlo/map_experiment.h"

namespace ehm::tuner_design {
namespace {

// Expected cost of an engine on one core, for the progress bar only.
constexpr double step_s = 0.2e-6, snapshot_s = 1e-6, steady_point_s = 50e-6;

void require_valid(const EvaluateOptions& options) {
  const auto refuse = [](const std::string& what) { throw std::invalid_argument(what); };
  if (!options.linear && !options.nonlinear) refuse("no truth is chosen; allowed: linear, nonlinear or both");
  if (!options.kalman && !options.map) refuse("no estimator is chosen; allowed: Kalman filter, MAP or both");
  if (!(options.wear > 0.0)) refuse("wear is " + std::to_string(options.wear) + "; allowed: above 0");
  if (options.runs < 2) refuse("runs is " + std::to_string(options.runs) + "; allowed: 2 or more");
  if (options.engines < 2) refuse("engines is " + std::to_string(options.engines) + "; allowed: 2 or more");
}

}  // namespace

Evaluation evaluate(const design::Design& design, const EvaluateOptions& options, const EvaluateProgress& progress) {
  require_valid(options);
  const Window window = window_of(options.seconds, options.window, design.model.sample_time_s);
  std::vector<Truth> truths;
  if (options.linear) truths.push_back(linear_truth(design));
  if (options.nonlinear) truths.push_back(nonlinear_truth(design, options.hold, options.engine));

  const auto cost_s = [&](const Truth& truth, bool kalman) {
    return (truth.nonlinear ? steady_point_s : 0.0) + (kalman ? window.samples * step_s : snapshot_s);
  };
  double total_s = 0.0, before_s = 0.0;
  for (const Truth& truth : truths) {
    if (options.kalman) total_s += static_cast<double>(options.runs) * cost_s(truth, true);
    if (options.map) total_s += static_cast<double>(options.engines) * cost_s(truth, false);
  }

  Evaluation result;
  for (const Truth& truth : truths) {
    const auto report = [&](double each_s) {
      return [&, each_s](std::size_t done) { progress((before_s + static_cast<double>(done) * each_s) / total_s); };
    };
    if (options.kalman) {
      const double each_s = cost_s(truth, true);
      const KalmanOptions kalman{options.runs,          window,      options.seed, options.threads,
                                 options.process_noise, options.wear};
      result.experiments.push_back(kalman_experiment(design, truth, kalman, report(each_s)));
      before_s += static_cast<double>(options.runs) * each_s;
    }
    if (options.map) {
      const double each_s = cost_s(truth, false);
      const MapOptions map{options.engines, options.seed, options.threads};
      for (Experiment& each : map_experiment(design, design.full.V, truth, map, report(each_s)))
        result.experiments.push_back(std::move(each));
      before_s += static_cast<double>(options.engines) * each_s;
    }
  }
  return result;
}

}  // namespace ehm::tuner_design
