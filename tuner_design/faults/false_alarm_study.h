// SPDX-License-Identifier: Apache-2.0
#pragma once
// How often does the monitor cry wolf? Engines of the fleet with nothing broken fly before the monitor's own cycle, on
// the design's linear model with its sensors' noise and its process noise, so that any engine can be tried, also one
// that is known as matrices only:
//
//   h ~ N(0, Ph), constant;   y[k] = trim + H h + C dx[k] + v[k]   (monte_carlo/engine_motion.h);   controls at trim
//
// Each flight is settled before it counts. What an event says that nothing broke is a false alarm; consequences of one
// (a second name, say) count as well. The number of events in a time is Poisson's: its exact two-sided 95 % interval
// (Garwood, Biometrika 28 (1936) 437) stands beside the rate that the options state.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "monitor/data/options.h"
#include "monitor/design/design.h"

namespace ehm::tuner_design {

struct FalseAlarmOptions {
  double hours = 10.0;        ///< counted, of all flights together
  bool process_noise = true;  ///< the engine moves by the model's w
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

struct FalseAlarmRow {
  std::string kind;
  double stated_per_hour = 0.0;  ///< what the monitor's options promise
  std::size_t events = 0;
  double per_hour = 0.0, lower_per_hour = 0.0, upper_per_hour = 0.0;  ///< measured, and its 95 % interval
  /// The data do not contradict the stated rate.
  bool holds() const { return lower_per_hour <= stated_per_hour; }
};

struct FalseAlarmStudy {
  std::size_t flights = 0;
  double flight_s = 0.0, hours = 0.0;
  bool process_noise = true;
  std::uint64_t withheld = 0;  ///< samples without estimates, counted time only
  std::vector<FalseAlarmRow> rows;
};

/// Exact 95 % interval of the mean of a Poisson variable that was `count`: {lower, upper}.
std::array<double, 2> poisson_interval(std::size_t count);

/// The same seed gives the same study on any number of threads.
/// @throws std::invalid_argument if the design's matrices do not fit together.
FalseAlarmStudy run_false_alarm_study(const design::Design& design, const FalseAlarmOptions& options,
                                      const std::function<void(double share)>& progress);

}  // namespace ehm::tuner_design
