// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/engine_control.h"

#include <algorithm>

namespace ehm::engine_sim {

EngineControl::EngineControl(const ControlData& data, const Measurements& start, double fuel_flow_kg_s)
    : data_(data),
      fuel_(data, start, fuel_flow_kg_s),
      vanes_(data.vanes.actuator, scheduled(data.vanes.schedule_deg, start.n2_corrected_rpm())),
      valves_(data.bleed_valves.actuator, bleed_valve_command(data, start, fuel_flow_kg_s)) {}

Actuation EngineControl::update(const Measurements& m, double n1_demand_rpm, double dt_s) {
  const double fuel_flow_kg_s = fuel_.update(m, n1_demand_rpm, dt_s);
  return {.fuel_flow_kg_s = fuel_flow_kg_s,
          .vsv_deg = vanes_.move(scheduled(data_.vanes.schedule_deg, m.n2_corrected_rpm()), dt_s),
          .vbv_fraction = valves_.move(bleed_valve_command(data_, m, fuel_flow_kg_s), dt_s),
          .active = fuel_.active()};
}

double bleed_valve_command(const ControlData& data, const Measurements& m, double fuel_flow_kg_s) {
  const double ratio_units = fuel_flow_kg_s / fuel_per_ratio_unit(m, data.fuel.theta_exponent);
  const double of_deceleration = ratio_units / scheduled(data.fuel.deceleration, m.n2_corrected_rpm());
  return std::max(scheduled(data.bleed_valves.low_speed, m.n2_corrected_rpm()),
                  scheduled(data.bleed_valves.deceleration, of_deceleration));
}

Geometry geometry(const VaneControlData& vanes, const Actuation& actuation, const Measurements& truth) {
  return {.vsv_deg = actuation.vsv_deg - scheduled(vanes.schedule_deg, truth.n2_corrected_rpm()),
          .vbv_fraction = actuation.vbv_fraction};
}

}  // namespace ehm::engine_sim
