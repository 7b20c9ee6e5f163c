// SPDX-License-Identifier: Apache-2.0
#pragma once
// A fleet of the flight study: every engine flown, what the figures need pooled. An engine that does not fly is counted
// and named, and in no figure. The same options give the same numbers on any number of threads.
// Errors: none; engines that fail are in `failed`.

#include <functional>
#include <string>
#include <vector>

#include "tuner_design/flight/flight_engine.h"

namespace ehm::tuner_design {

struct FailedEngine {
  std::size_t index;
  std::string why;
};

struct FleetResult {
  std::size_t flown = 0;
  std::vector<FailedEngine> failed;
  double estimated = 0.0;  ///< share of the samples
  double ssee_700 = 0, claim_700 = 0, ssee_landing = 0, claim_landing = 0, worst_landing = 0;
  double false_steps = 0;                                   ///< found where there was none, a flight
  std::size_t steps = 0, steps_found = 0, steps_named = 0;  ///< of engines with one
  double step_delay_s = 0;                                  ///< mean, of those found
  /// The same of a sensor that becomes biased.
  double false_biases = 0;
  std::size_t biases = 0, biases_found = 0, biases_named = 0;
  double bias_delay_s = 0;
  double health_coverage = 0, worst_health_coverage = 0;
  std::vector<double> steady_coverage, slam_coverage;  ///< by auxiliary output
  std::vector<double> health_coverage_by_channel;
};

FleetResult fly_fleet(
    const FlightStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
