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

/// How something that happened in flight was found, over a fleet.
struct Findings {
  std::size_t happened = 0, found = 0, named = 0;  ///< engines
  double delay_s = 0;                              ///< mean, of those found
  double false_alarms = 0;                         ///< found where there was nothing, a flight
};

struct FleetResult {
  std::size_t flown = 0;
  std::vector<FailedEngine> failed;
  double estimated = 0.0;  ///< share of the samples
  double ssee_700 = 0, claim_700 = 0, ssee_landing = 0, claim_landing = 0, worst_landing = 0;
  Findings steps, biases;  ///< of health, and of sensors
  double health_coverage = 0, worst_health_coverage = 0;
  std::vector<double> steady_coverage, slam_coverage;  ///< by auxiliary output
  std::vector<double> health_coverage_by_channel;
};

FleetResult fly_fleet(
    const FlightStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
