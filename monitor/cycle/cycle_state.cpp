// SPDX-License-Identifier: Apache-2.0
#include "monitor/cycle/cycle_state.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

namespace reason = idl::reject_reason;

Continuation continuation(const CycleState& state, const Sample& next, double sample_time_s,
                          double max_gap_s) noexcept {
  SourceClock clock;
  SequenceOrder order;
  clock.start(state.source_time_ns);
  order.start(state.sequence);
  const Elapsed elapsed = clock.elapsed(next.source_time_ns);
  const std::uint64_t ahead = order.place(next.sequence, elapsed, sample_time_s).ahead;
  Continuation c{Resumption::taken, elapsed.told ? elapsed.dt_s : sample_time_s * static_cast<double>(ahead), ahead};
  if (next.source_id != state.source_id)
    c.verdict = Resumption::other_source;
  else if (ahead == 0 || c.gap_s < 0.0)
    c.verdict = Resumption::not_later;
  else if (c.gap_s > max_gap_s)
    c.verdict = Resumption::too_old;
  return c;
}

bool MonitorCycle::snapshot(CycleState& state) const noexcept {
  // A fault that was just declared is still in the estimate, and its size is not part of the state.
  if (!result_.estimates || verdict_.fault.kind != FaultKind::none) return false;
  state.source_id = intake_.source_id();
  state.sequence = intake_.last_sequence();
  state.source_time_ns = intake_.last_time_ns();
  watch_.save(state.watch);
  companions_.save(state.companions);
  state.excluded.reset();
  for (int i = 0; i < sensors_; ++i) state.excluded[as_size(i)] = supervision_.excluded(i);
  state.return_gate = accommodation_.memory();
  state.bias_return = bias_return_.memory();
  return true;
}

Resumption MonitorCycle::resume(const CycleState& state, const Sample& next, double max_gap_s) noexcept {
  const Continuation next_is = continuation(state, next, design_->model.sample_time_s, max_gap_s);
  if (next_is.verdict != Resumption::taken) return next_is.verdict;
  if (!watch_.restore(state.watch)) return Resumption::wrong_shape;
  const int missing = watch_.filter().sensor_set().missing();
  accommodation_.resume(missing, state.return_gate);
  const Eigen::Index settling = detection_.detector().signatures().settling_samples;
  detection_.resume(missing, std::max<Eigen::Index>(state.watch.error.remaining, settling / 3));
  for (int i = 0; i < sensors_; ++i) {
    if (!state.excluded[as_size(i)]) continue;
    supervision_.exclude(
        i, {.kind = idl::EventKind::sensor_fault, .channel = static_cast<std::uint32_t>(i), .detail = reason::excluded},
        events_);
  }
  if (state.bias_return.sensor < sensors_) bias_return_.remember(state.bias_return);
  // The actuators are taken to have been for the whole gap where they are now: the states follow them there. Longer
  // than the filter needs to settle makes no difference.
  now_ = conditions_of(next);
  for (int i = 0; i < actuators_; ++i)
    if (!std::isfinite(now_.actuators(i))) now_.actuators(i) = design_->model.controls[as_size(i)].trim;
  before_ = now_;
  const std::uint64_t unseen = std::min<std::uint64_t>(next_is.ahead - 1, watch_.settling_samples());
  watch_.fly_blind(now_.actuators, unseen);
  return companions_.restore(state.companions, static_cast<int>(unseen)) ? Resumption::taken
                                                                         : Resumption::companions_cold;
}

}  // namespace ehm::monitor
