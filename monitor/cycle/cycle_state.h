// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a MonitorCycle needs to go on where another one of the same design stopped: for a checkpoint, and for a change
// of options in flight. Plain data; a copy to one with as many companions allocates nothing.
//
// Kept: the state of each estimator, excluded sensors with the memory of their return, and where in the source's stream
// it was. Not kept, and starting anew: the windows of the detectors and of the single-sensor checks.

#include <cstdint>
#include <string_view>
#include <vector>

#include "monitor/checks/bias_return.h"
#include "monitor/checks/return_gate.h"
#include "monitor/data/sample.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/estimator_state.h"

namespace ehm::monitor {

/// Of an estimator that flies beside the watch filter.
struct CompanionState {
  std::string_view name;  ///< of the table of estimators (design/make_estimator.h)
  estimation::EstimatorState state;
};

struct CycleState {
  std::uint32_t source_id = 0;  ///< of the latest sample in order, as are the next two
  std::uint64_t sequence = 0;
  std::int64_t source_time_ns = 0;
  estimation::EstimatorState watch;        ///< of the watch filter
  std::vector<CompanionState> companions;  ///< of as many as fly
  estimation::SensorMask excluded;         ///< sensors that are declared faulty
  ReturnGate::Memory return_gate;          ///< of the sensor that the watch filter's design lacks
  BiasReturn::Memory bias_return;          ///< of the sensor that was left out beyond the point
};

/// What became of a state, and why it was not taken.
enum class Resumption : std::uint32_t {
  taken = 0,
  wrong_shape = 1,     ///< not of this design
  other_source = 2,    ///< the sample comes from another source than the state's
  not_later = 3,       ///< the source has started anew since
  too_old = 4,         ///< by the source's clock, or by the sequence where its stamps tell nothing
  companions_cold = 5  ///< taken, but for an estimator beside the watch filter that it does not hold, or not so
};

constexpr bool went_on(Resumption verdict) noexcept {
  return verdict == Resumption::taken || verdict == Resumption::companions_cold;
}

/// How a sample continues the stream in which a state was taken. Real-time safe: yes.
struct Continuation {
  Resumption verdict = Resumption::taken;
  double gap_s = 0.0;       ///< from the state to the sample
  std::uint64_t ahead = 0;  ///< samples from the state's to this; 1: the next
};
Continuation continuation(const CycleState& state, const Sample& next, double sample_time_s, double max_gap_s) noexcept;

}  // namespace ehm::monitor
