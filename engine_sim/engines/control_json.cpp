// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/control_json.h"

#include "engine_sim/engines/json_fields.h"

namespace ehm::engine_sim {
namespace {

using files::Json;
using files::JsonObject;

constexpr NumberField<EngineLimits> limit_fields[] = {
    {"n1_rpm", &EngineLimits::n1_rpm, 100.0, 1e5, "rpm"},
    {"n1_corrected_rpm", &EngineLimits::n1_corrected_rpm, 100.0, 1e5, "rpm"},
    {"n2_rpm", &EngineLimits::n2_rpm, 100.0, 1e5, "rpm"},
    {"n2_corrected_rpm", &EngineLimits::n2_corrected_rpm, 100.0, 1e5, "rpm"},
    {"t48_k", &EngineLimits::t48_k, 500.0, 2000.0, "K"},
    {"ps_30_pa", &EngineLimits::ps_30_pa, 1e5, 1e7, "Pa"},
    {"ground_idle_n2_corrected_rpm", &EngineLimits::ground_idle_n2_corrected_rpm, 100.0, 1e5, "rpm"},
    {"flight_idle_n2_corrected_rpm", &EngineLimits::flight_idle_n2_corrected_rpm, 100.0, 1e5, "rpm"}};
constexpr NumberField<FuelResponse> response_fields[] = {
    {"gain", &FuelResponse::gain, 1e-3, 10.0, "d ln y/d ln Wf"},
    {"lag_s_at_sea_level", &FuelResponse::lag_s_at_sea_level, 0.0, 10.0, "s"}};
using F = FuelControlData;
constexpr NumberField<F> fuel_fields[] = {
    {"speed_bandwidth_rad_s", &F::speed_bandwidth_rad_s, 0.1, 10.0, "rad/s"},
    {"t48_bandwidth_rad_s", &F::t48_bandwidth_rad_s, 0.1, 20.0, "rad/s"},
    {"ps_30_bandwidth_rad_s", &F::ps_30_bandwidth_rad_s, 0.1, 20.0, "rad/s"},
    {"reference_band", &F::reference_band, 1e-4, 1.0, "of the demand"},
    {"reference_fuel_rate_per_s", &F::reference_fuel_rate_per_s, 1e-3, 10.0, "1/s"},
    {"theta_exponent", &F::theta_exponent, 0.0, 2.0, "power of theta2"},
    {"slew_per_s", &F::slew_per_s, 1e-2, 100.0, "1/s"},
    {"fuel_min_kg_s", &F::fuel_min_kg_s, 1e-4, 100.0, "kg/s"},
    {"fuel_max_kg_s", &F::fuel_max_kg_s, 1e-3, 100.0, "kg/s"}};
constexpr NumberField<ActuatorData> actuator_fields[] = {
    {"lag_s", &ActuatorData::lag_s, 0.0, 10.0, "s"},
    {"rising_per_s", &ActuatorData::rising_per_s, 1e-6, 1e3, "1/s"},
    {"falling_per_s", &ActuatorData::falling_per_s, 1e-6, 1e3, "1/s"}};
constexpr NumberField<ControlData> control_fields[] = {
    {"middle_n1_corrected_rpm", &ControlData::middle_n1_corrected_rpm, 100.0, 1e5, "rpm"}};

struct FuelSchedule {
  const char* key;
  Schedule F::*value;
  double lowest, highest;
  const char* unit;
};
constexpr FuelSchedule fuel_schedules[] = {
    {"n1_gain", &F::n1_gain, 1e-3, 10.0, "d ln N1/d ln Wf over N1 corrected"},
    {"n1_lag_s", &F::n1_lag_s, 1e-3, 10.0, "s over N1 corrected"},
    {"n2_gain", &F::n2_gain, 1e-3, 10.0, "d ln N2/d ln Wf over N1 corrected"},
    {"n2_lag_s", &F::n2_lag_s, 1e-3, 10.0, "s over N1 corrected"},
    {"acceleration", &F::acceleration, 1e-3, 100.0, "ratio units over N2 corrected"},
    {"deceleration", &F::deceleration, 1e-3, 100.0, "ratio units over N2 corrected"}};

Schedule schedule_from(JsonObject& object, const char* key, double lowest, double highest, const char* unit) {
  Schedule schedule;
  for (const auto& [at, value] : pair_list(object, key, lowest, highest, unit)) schedule.push_back({at, value});
  return schedule;
}

Json schedule_to_json(const Schedule& schedule) {
  NumberPairs pairs;
  for (const auto& [at, value] : schedule) pairs.emplace_back(at, value);
  return pairs_to_json(pairs);
}

EngineLimits limits_from(JsonObject& control) {
  const EngineLimits limits = object_of(control, "limits", limit_fields);
  if (!(limits.ground_idle_n2_corrected_rpm <= limits.flight_idle_n2_corrected_rpm &&
        limits.flight_idle_n2_corrected_rpm < limits.n2_corrected_rpm))
    throw_field_defect(control, "limits.flight_idle_n2_corrected_rpm",
                       files::shown(limits.flight_idle_n2_corrected_rpm),
                       "from ground_idle_n2_corrected_rpm (" + files::shown(limits.ground_idle_n2_corrected_rpm) +
                           ") to below n2_corrected_rpm (" + files::shown(limits.n2_corrected_rpm) + ")",
                       "Correct one of them");
  return limits;
}

/// Both are linear between their points: it is enough to look there.
void require_room_between(const JsonObject& object, const F& fuel) {
  for (const Schedule* schedule : {&fuel.acceleration, &fuel.deceleration})
    for (const SchedulePoint& point : *schedule) {
      const double least = scheduled(fuel.deceleration, point.at), most = scheduled(fuel.acceleration, point.at);
      if (!(least < most))
        throw_field_defect(object, "deceleration",
                           files::shown(least) + " at N2 corrected " + files::shown(point.at) + " rpm",
                           "less than acceleration, " + files::shown(most) + " there", "Correct one of them");
    }
  if (!(fuel.fuel_min_kg_s < fuel.fuel_max_kg_s))
    throw_field_defect(object, "fuel_min_kg_s", files::shown(fuel.fuel_min_kg_s),
                       "less than fuel_max_kg_s, " + files::shown(fuel.fuel_max_kg_s), "Correct one of them");
}

F fuel_from(JsonObject& control) {
  JsonObject object(control.at("fuel"), control.file(), control.key("fuel"));
  F fuel{};
  for (const FuelSchedule& s : fuel_schedules)
    fuel.*s.value = schedule_from(object, s.key, s.lowest, s.highest, s.unit);
  fuel.t48 = object_of(object, "t48", response_fields);
  fuel.ps_30 = object_of(object, "ps_30", response_fields);
  read_fields(object, fuel_fields, fuel);
  object.refuse_unknown();
  require_room_between(object, fuel);
  return fuel;
}

Json to_json(const F& fuel) {
  Json json = json_of(fuel_fields, fuel);
  for (const FuelSchedule& s : fuel_schedules) json[s.key] = schedule_to_json(fuel.*s.value);
  json["t48"] = json_of(response_fields, fuel.t48);
  json["ps_30"] = json_of(response_fields, fuel.ps_30);
  return json;
}

VaneControlData vanes_from(JsonObject& control) {
  JsonObject object(control.at("vanes"), control.file(), control.key("vanes"));
  VaneControlData vanes{schedule_from(object, "schedule_deg", -90.0, 90.0, "deg over N2 corrected"),
                        object_of(object, "actuator", actuator_fields)};
  object.refuse_unknown();
  return vanes;
}

BleedValveControlData bleed_valves_from(JsonObject& control) {
  JsonObject object(control.at("bleed_valves"), control.file(), control.key("bleed_valves"));
  BleedValveControlData valves{
      schedule_from(object, "low_speed", 0.0, 0.5, "fraction over N2 corrected"),
      schedule_from(object, "deceleration", 0.0, 0.5, "fraction over ratio units to the deceleration schedule"),
      object_of(object, "actuator", actuator_fields)};
  object.refuse_unknown();
  return valves;
}

}  // namespace

ControlData control_from(JsonObject& root) {
  JsonObject object(root.at("control"), root.file(), root.key("control"));
  ControlData control{.limits = limits_from(object),
                      .fuel = fuel_from(object),
                      .vanes = vanes_from(object),
                      .bleed_valves = bleed_valves_from(object),
                      .middle_n1_corrected_rpm = 0.0};
  read_fields(object, control_fields, control);
  object.refuse_unknown();
  return control;
}

Json to_json(const ControlData& control) {
  Json json = json_of(control_fields, control);
  json["limits"] = json_of(limit_fields, control.limits);
  json["fuel"] = to_json(control.fuel);
  json["vanes"] = {{"schedule_deg", schedule_to_json(control.vanes.schedule_deg)},
                   {"actuator", json_of(actuator_fields, control.vanes.actuator)}};
  json["bleed_valves"] = {{"low_speed", schedule_to_json(control.bleed_valves.low_speed)},
                          {"deceleration", schedule_to_json(control.bleed_valves.deceleration)},
                          {"actuator", json_of(actuator_fields, control.bleed_valves.actuator)}};
  return json;
}

}  // namespace ehm::engine_sim
