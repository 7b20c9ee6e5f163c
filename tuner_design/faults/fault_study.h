// SPDX-License-Identifier: Apache-2.0
#pragma once
// The study of the fault detector: seeded cases from the table (fault_case.h) and hours with nothing broken, all on the
// nonlinear engine with the monitor's own cycle (fault_flight.h). The same seed gives the same study on any number of
// threads.

#include <cstdint>
#include <functional>
#include <vector>

#include "engine_sim/engines/jt9d_engine.h"
#include "tuner_design/faults/fault_flight.h"

namespace ehm::tuner_design {

struct FaultStudyOptions {
  std::size_t cases = 400;
  double hours = 32.0;  ///< with nothing broken; of one in twenty engines the monitor withholds estimates
  std::uint64_t seed = 1;
  unsigned threads = 1;
  std::shared_ptr<const engine_sim::EngineDefinition> engine = engine_sim::default_engine();
};

/// What became of the cases of one row of the table.
struct FaultRowSummary {
  const FaultRow* row = nullptr;
  std::size_t flown = 0, found_in_time = 0;  ///< something said within abrupt_limit_s
  std::size_t right = 0;                     ///< the sensor; a component for a component; nothing for nothing
  std::size_t wrong_sensor = 0, component = 0, ambiguous = 0, slow_bias = 0, silent = 0;  ///< of the others
  double median_delay_s = 0.0;                                                            ///< of those found
};

struct FaultStudy {
  std::vector<FaultCase> cases;
  std::vector<FaultOutcome> outcomes;
  std::vector<std::string> sensors, health;
  std::vector<FaultRowSummary> rows;
  std::size_t not_flown = 0;
  std::size_t early_alarms = 0;  ///< in the cases, before anything broke
  double fault_free_hours = 0.0;
  std::size_t false_alarms = 0;  ///< within them
  double largest_step_sigmas = 0.0;
  // The figures of the whole study; shares from 0 to 1.
  double found = 0.0;                 ///< of biases of 5 sigma, within 3 s
  double right_sensor = 0.0;          ///< of biases of 5 sigma, the biased sensor named
  double ambiguous_of_rest = 0.0;     ///< of the biases of 5 sigma that were not named rightly
  double component_not_sensor = 0.0;  ///< component steps not called a sensor fault
};

inline constexpr double abrupt_limit_s = 3.0;

/// @throws std::invalid_argument if the design is not for `options.engine`.
FaultStudy run_fault_study(const design::Design& design, const FaultStudyOptions& options,
                           const std::function<void(double share)>& progress);

}  // namespace ehm::tuner_design
