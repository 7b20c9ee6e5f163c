// SPDX-License-Identifier: Apache-2.0
#pragma once
// Filters on batches of samples from an engine that wears: `runs` engines of the same law of wear and different noise,
// a batch of `samples` each flight. All filters see the same samples. Errors are those of the last sample of a flight,
// percent of nominal. The engine starts a flight as it ended the last one, and is in balance with its health at the
// first. Per run the noise depends on seed and run alone: the same on any number of threads.

#include <cstdint>
#include <functional>

#include "tuner_design/kosanam/batch_filter.h"
#include "tuner_design/wear/wear_law.h"

namespace ehm::tuner_design {

struct BatchOptions {
  int runs = 30, flights = 500, samples = 30;
  double cycles_a_flight = 12.0;
  double equal_wear_percent = 0.0;  ///< wear_law.h
  double noise_factor = 1.0;        ///< of the sensors' variance in the engine, which the filters do not know
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// Of one filter over runs and flights, by health parameter.
struct BatchErrors {
  std::string name;
  Eigen::VectorXd rms, bias;  ///< percent; bias: estimate less truth, in the direction of wear
  Eigen::VectorXd coverage;   ///< share of the truth within 1.96 of the sigma that was stated
  Eigen::MatrixXd first_run;  ///< p x flights, percent: the estimates of one engine
};

struct BatchResult {
  std::vector<BatchErrors> filters;
  Eigen::VectorXd change;  ///< of health from new to the last flight, percent, its size
  Eigen::MatrixXd truth;   ///< p x flights, percent, of every engine

  /// Mean over the parameters of rms over change, percent: the theses' "percent" (*reading*).
  double of_change(std::size_t filter) const;
  /// Of one parameter.
  double of_change(std::size_t filter, Eigen::Index parameter) const;
  double mean_rms(std::size_t filter) const { return filters[filter].rms.mean(); }
};

BatchResult fly_batches(
    const BatchProblem& problem, const std::vector<FilterCase>& cases, const BatchOptions& options,
    const std::function<void(std::size_t)>& progress = [](std::size_t) {});

}  // namespace ehm::tuner_design
