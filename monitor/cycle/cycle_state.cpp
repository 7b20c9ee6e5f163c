#include "monitor/cycle/cycle_state.h"

#include <algorithm>
#include <cmath>

#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"

namespace ehm::monitor {

namespace {

using estimation::SensorSet;

SensorSet set_of(const CycleState& state) noexcept {
  return state.missing_sensor < 0 ? SensorSet::full() : SensorSet::without(state.missing_sensor);
}

bool same_shape(const estimation::ErrorState& state, const estimation::ErrorModel& model) noexcept {
  return state.mean.rows() == model.drive.rows() && state.mean.cols() == model.drive.cols() &&
         state.covariance.rows() == model.noise.rows() && state.covariance.cols() == model.noise.cols() &&
         state.remaining <= model.settling_samples;
}

}  // namespace

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
  if (!result_.estimates || declared_.kind != FaultKind::none) return false;
  state.source_id = sample_check_.source_id();
  state.sequence = sample_check_.last_sequence();
  state.source_time_ns = sample_check_.last_time_ns();
  state.missing_sensor = filter_.sensor_set().missing();
  state.estimate = filter_.estimate();
  state.error = error_.state();
  state.excluded.reset();
  for (std::size_t i = 0; i < qualification_.size(); ++i)
    state.excluded[i] = qualification_[i].state() == Qualification::State::excluded;
  state.return_gate = return_gate_.memory();
  return true;
}

Resumption MonitorCycle::resume(const CycleState& state, const Sample& next, double max_gap_s) noexcept {
  const Continuation next_is = continuation(state, next, design_->model.sample_time_s, max_gap_s);
  if (next_is.verdict != Resumption::taken) return next_is.verdict;
  const auto design = static_cast<std::size_t>(1 + state.missing_sensor);
  if (design >= error_models_->size() || !same_shape(state.error, (*error_models_)[design]))
    return Resumption::wrong_shape;
  if (!filter_.restore(set_of(state), state.estimate)) return Resumption::wrong_shape;
  error_.restore((*error_models_)[design], state.error);
  return_gate_.resume(state.return_gate);
  gated_sensor_ = state.missing_sensor;
  shift_.reset();
  ungated_.reset();
  faults_.start(state.missing_sensor,
                std::max<Eigen::Index>(state.error.remaining, faults_.signatures().settling_samples / 3));
  for (int i = 0; i < sensors_; ++i) {
    const auto s = static_cast<std::size_t>(i);
    if (!state.excluded[s]) continue;
    qualification_[s].exclude();
    sensor_fault_[s].set(
        true,
        {idl::EventKind::sensor_fault, static_cast<std::uint32_t>(i), true, 0.0, 0.0, idl::reject_reason::excluded},
        events_);
  }
  fly_blind_to(next, next_is.ahead - 1);
  return Resumption::taken;
}

void MonitorCycle::fly_blind_to(const Sample& next, std::uint64_t missing) noexcept {
  // The actuators are taken to have been for the whole gap where they are now: the states follow them there. Longer
  // than the filter needs to settle makes no difference.
  for (int i = 0; i < actuators_; ++i) {
    const double du = next.actuator[static_cast<std::size_t>(i)] - actuator_trim_(i);
    du_(i) = std::isfinite(du) ? du : 0.0;
  }
  const auto bound = static_cast<std::uint64_t>(error_models_->front().settling_samples);
  for (std::uint64_t k = std::min(missing, bound); k > 0; --k) {
    filter_.predict(du_);
    filter_.update({});
  }
  du_previous_ = du_;
}

}  // namespace ehm::monitor
