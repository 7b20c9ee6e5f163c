// SPDX-License-Identifier: Apache-2.0
#include "monitor/flight/flight_log.h"

#include <algorithm>
#include <limits>

#include "deploy/runtime/numbers/index.h"

namespace ehm::monitor {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_exceedance(idl::EventKind kind) {
  return kind == idl::EventKind::health_limit || kind == idl::EventKind::auxiliary_limit;
}

}  // namespace

bool FlightLog::follow(const MonitorCycle& cycle, const FanSpeed& fan) noexcept {
  const Sample& sample = cycle.intake().sample();
  const double dt_s = cycle.steps() * cycle.design().model.sample_time_s;
  // Where no estimate is made the sensors are as good.
  const bool measured =
      fan.sensor >= 0 && (cycle.result().reason[as_size(fan.sensor)] & ~idl::reject_reason::withheld) == 0;
  const double n1_rpm = measured ? sample.sensor[as_size(fan.sensor)] : std::numeric_limits<double>::quiet_NaN();
  const FlightChange change = path_.follow(sample.flight, n1_rpm, fan.trim_corrected_rpm, dt_s);
  if (change == FlightChange::took_off) {
    present_.flight = ++flights_;
    present_.start_ns = sample.source_time_ns;
  }
  if (change == FlightChange::rejected) {
    --flights_;
    const auto on_ground_s = present_.phase_s;
    present_ = {};
    present_.phase_s = on_ground_s;
  }
  if (change != FlightChange::landed) {
    note(cycle, dt_s);
    return false;
  }
  present_.landing_ns = sample.source_time_ns;
  finished_ = present_;
  present_ = {};
  return true;
}

void FlightLog::note(const MonitorCycle& cycle, double dt_s) noexcept {
  present_.phase_s[static_cast<std::size_t>(path_.phase())] += dt_s;
  if (!path_.in_flight()) return;
  const CycleResult& result = cycle.result();
  ++present_.samples;
  for (const Event& event : cycle.events()) {
    present_.events += event.raised;
    present_.exceedances += event.raised && is_exceedance(event.kind);
  }
  if (present_.sensor_greatest.size() == 0)
    present_.sensor_greatest.setConstant(as_index(cycle.design().model.sensors.size()), -infinity);
  note_extremes(result, cycle.intake().sample());
  if (!result.estimates) return;
  ++present_.estimated;
  present_.flags = result.flags;
  present_.health = result.estimate.health;
  present_.health_sigma = result.estimate.health_sigma;
}

void FlightLog::note_extremes(const CycleResult& result, const Sample& sample) noexcept {
  for (Eigen::Index i = 0; i < present_.sensor_greatest.size(); ++i)
    if (result.fused[as_size(i)])
      present_.sensor_greatest(i) = std::max(present_.sensor_greatest(i), sample.sensor[as_size(i)]);
  if (!result.estimates) return;
  const estimation::AuxiliaryVector& z = result.estimate.auxiliary;
  if (present_.auxiliary_least.size() == 0) {
    present_.auxiliary_least = present_.auxiliary_greatest = z;
    return;
  }
  present_.auxiliary_least = present_.auxiliary_least.cwiseMin(z);
  present_.auxiliary_greatest = present_.auxiliary_greatest.cwiseMax(z);
}

}  // namespace ehm::monitor
