// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the monitor's cycle says of something that broke, as its events tell it; and the samples that it is given.
// Errors: none.

#include <cstddef>
#include <optional>

#include "engine_sim/simulated_engine.h"
#include "monitor/data/events.h"
#include "monitor/data/sample.h"
#include "tuner_design/faults/fault_case.h"

namespace ehm::tuner_design {

enum class Answer { nothing, sensor, component, ambiguous, slow_bias };

struct FaultOutcome {
  bool flown = false;                ///< false: no steady point, or no estimate where it broke
  Answer answer = Answer::nothing;   ///< the first name; ambiguous only if no name came
  std::size_t channel = 0;           ///< of the answer: sensor or health parameter
  std::optional<double> delay_s;     ///< from the onset to whatever was said first
  std::optional<double> named_s;     ///< from the onset to the answer
  double size = 0.0;                 ///< as the event says, channel units
  double largest_step_sigmas = 0.0;  ///< of a health estimate when another sensor set took over, in published sigmas
  int false_alarms = 0;              ///< before the onset, or with nothing broken
};

/// "sensor", "component", "ambiguous", "slow_bias", "nothing"
const char* name_of(Answer answer);

/// It names something that broke, or that something did.
bool is_answer(const monitor::Event& event);

/// Writes down what the events of one sample answer.
void note_answer(const monitor::Event& event, double since_onset_s, bool broken, FaultOutcome& outcome);

/// The right sensor was named, for a component any component; with nothing broken, nothing was.
bool is_right(const FaultCase& what, const FaultOutcome& outcome);

void to_sample(const engine_sim::EngineSample& from, double time_s, monitor::Sample& to);

/// `row` of a sensor whose noise is `sigma`; a drift goes the way of `sign`.
engine_sim::SensorFault sensor_fault(const FaultRow& row, double sigma, double onset_s, double sign);

}  // namespace ehm::tuner_design
