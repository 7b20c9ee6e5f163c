// SPDX-License-Identifier: Apache-2.0
#pragma once
// One engine flies the whole two-hour mission before the very cycle that the monitor flies, at the design's sample time,
// with an estimator published that holds everywhere; everything of the truth is perturbed
// (flight/mission_scenario.h). Things break by turns, in slots, and mend again:
//
//   every 140 s from 700 s on       what breaks is watched as long as its row says (fault_case.h), then it is whole
//   3 s after each change of power  the same, within the transient
//
// Biases, drifts and noise are in sigmas of the present reading. A slot counts if the sensor was in use, and estimates
// were there, as it began. Errors: a flight that ends early has the slots until then; `why` says what ended it.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "monitor/cycle/prepared_design.h"
#include "tuner_design/faults/fault_flight.h"
#include "tuner_design/flight/mission_scenario.h"

namespace ehm::tuner_design {

/// Where in the flight something broke.
enum class Moment : std::size_t { steady, climbing, descending, transient };
inline constexpr std::array<std::string_view, 4> moment_names{"steady", "climbing", "descending", "transient"};

struct MissionSlot {
  double onset_s;
  Moment moment;
  FaultCase what;
};

struct SlotOutcome {
  MissionSlot slot;
  FaultOutcome outcome;
};

struct MissionOutcome {
  std::vector<SlotOutcome> slots;
  double flown_s = 0.0;          ///< with estimates, nothing broken, nothing just mended
  std::size_t false_alarms = 0;  ///< events that name something, within flown_s
  double samples = 0.0, estimated = 0.0;
  std::size_t judged = 0, covered = 0;             ///< health channels every 20 s, within 1.96 sigma
  double ssee_landing = 0.0, claim_landing = 0.0;  ///< percent^2
  std::string why;                                 ///< empty: flown to the end
};

/// The slots of flight `index`; over the flights of a study every case comes round in every moment.
std::vector<MissionSlot> mission_slots(std::size_t sensors, std::size_t health, std::uint64_t index);

/// `study.prepared` publishes the estimator. Without slots nothing breaks. The same draw and index give the same
/// flight. Callable by several threads at once.
MissionOutcome fly_mission(const StudyEngine& study, const std::vector<MissionSlot>& slots,
                           const monitor::CycleOptions& options, const MissionDraw& draw, std::uint64_t index);

}  // namespace ehm::tuner_design
