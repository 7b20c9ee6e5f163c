// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/scenario_file.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "deploy/runtime/config/table_reader.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/scenario/linear_model_file.h"
#include "engine_sim/scenario/linear_scenario.h"
#include "engine_sim/scenario/power_lever.h"
#include "idl/fault_names.h"

namespace ehm::engine_sim {

using config::ConfigError;
using config::Schema;
using config::TableReader;

namespace {

constexpr double far_future_s = 1e9;
constexpr double most_bleed_kg_s = 10, most_power_w = 1e6;
constexpr double fastest_n1_rpm = 30'000;  // of any engine; the control holds the limit of this one

template <class Names>
std::vector<std::string> list_of(const Names& names) {
  std::vector<std::string> list;
  for (const auto& n : names) {
    if constexpr (requires { n.name; })
      list.emplace_back(n.name);
    else
      list.emplace_back(n);
  }
  return list;
}

std::vector<std::string> sensor_names(const EngineDefinition& engine) {
  std::vector<std::string> names;
  for (const SensorChannel& sensor : engine.channels.sensors) names.emplace_back(sensor.quantity->name);
  return names;
}

/// What the tables call the channels of the engine that flies.
struct Names {
  std::vector<std::string> health, sensors, controls;
  std::vector<double> health_unit;  ///< one, in the parameter's unit
};

/// `health_unit`, but 0 of what the truth of the engine that flies does not show.
std::vector<double> shown_units(const SimConfig& c, const Names& names) {
  if (c.linear) return names.health_unit;
  std::vector<double> unit(names.health.size());
  for (const HealthChannel& channel : c.scenario.engine->channels.health)
    unit[channel.parameter] = names.health_unit[channel.parameter];
  return unit;
}

/// Reads the engine that flies, or the linear model, at the first call.
Names names_of(SimConfig& c) {
  if (c.linear_file.empty()) {
    c.engine_keys.take_engine(c.scenario);
    return {list_of(health_names), sensor_names(*c.scenario.engine), {}, std::vector<double>(health_count, 1.0)};
  }
  if (!c.linear) {
    c.linear = read_linear_model(c.linear_file);
    c.scenario.wear.clear();
    for (const auto& parameter : c.linear->health) c.scenario.wear.push_back({.initial = parameter.trim});
  }
  Names names{list_of(c.linear->health), list_of(c.linear->sensors), list_of(c.linear->controls), {}};
  for (const auto& parameter : c.linear->health) names.health_unit.push_back(linear_model::unit_of_health(parameter));
  return names;
}

/// Which of `names` the key names.
std::size_t index_of(TableReader& t, const std::string& key, const std::vector<std::string>& names) {
  return as_size(std::find(names.begin(), names.end(), t.choice(key, names)) - names.begin());
}

void for_each_table(const std::string& file, const std::string& name, const toml::array& array,
                    const std::function<void(TableReader&)>& read) {
  for (const auto& element : array) {
    TableReader reader(file, name, *element.as_table());
    read(reader);
    reader.finish();
  }
}

Demand profile_demand(TableReader& t, std::optional<double> lever_percent) {
  if (lever_percent) return {DemandKind::n1_rpm, 0.0};  // once the engine is known: finish_config
  if (!t.has("net_thrust_n")) return {DemandKind::n1_rpm, t.real("n1_rpm", 500, fastest_n1_rpm)};
  return {DemandKind::net_thrust_n, t.real("net_thrust_n", 0, 1e6)};
}

void declare_profile(Schema& schema, SimConfig& c) {
  schema.tables(
      "profile",
      "flight and demand over time: time_s; n1_rpm, net_thrust_n or power_lever_percent (one of them throughout); and "
      "optionally altitude_m, mach, delta_isa_k, customer_bleed_kg_s, power_w",
      [&c, &s = c.scenario](const std::string& file, const toml::array& array) {
        for_each_table(file, "profile", array, [&](TableReader& t) {
          c.profile_levers.emplace_back();
          if (t.has("power_lever_percent")) c.profile_levers.back() = t.real("power_lever_percent", 0, 100);
          const FlightCondition before = s.profile.empty() ? s.flight : s.profile.back().flight;
          const Offtake taken = s.profile.empty() ? s.offtake : s.profile.back().offtake;
          s.profile.push_back(
              {t.real("time_s", 0, far_future_s),
               {t.real_or("altitude_m", before.altitude_m, -500, 15000), t.real_or("mach", before.mach, 0, 0.95),
                t.real_or("delta_isa_k", before.delta_isa_k, -60, 60)},
               profile_demand(t, c.profile_levers.back()),
               {t.real_or("customer_bleed_kg_s", taken.customer_bleed_kg_s, 0, most_bleed_kg_s),
                t.real_or("power_w", taken.power_w, 0, most_power_w)}});
        });
      });
}

void declare_health(Schema& schema, SimConfig& c) {
  schema.tables("wear",
                "wear at the start and its drift: parameter, initial, drift_per_hour (fractions, or in the linear "
                "model's unit; negative is lost)",
                [&c](const std::string& file, const toml::array& array) {
                  const Names names = names_of(c);
                  for_each_table(file, "wear", array, [&](TableReader& t) {
                    const std::size_t parameter = index_of(t, "parameter", names.health);
                    const double unit = names.health_unit[parameter];
                    Wear& wear = c.scenario.wear[parameter];
                    wear.initial = t.real_or("initial", wear.initial, health_min * unit, health_max * unit);
                    wear.drift_per_s = t.real_or("drift_per_hour", 0.0, -10 * unit, 10 * unit) / 3600.0;
                  });
                });
  schema.tables("health_change", "a change of health in flight: time_s, parameter, change, ramp_s",
                [&c](const std::string& file, const toml::array& array) {
                  const Names names = names_of(c);
                  for_each_table(file, "health_change", array, [&](TableReader& t) {
                    const double time_s = t.real("time_s", 0, far_future_s);
                    const std::size_t parameter = index_of(t, "parameter", names.health);
                    const double unit = names.health_unit[parameter];
                    c.scenario.health_changes.push_back({time_s, parameter,
                                                         t.real("change", health_min * unit, health_max * unit),
                                                         t.real_or("ramp_s", 0.0, 0, far_future_s)});
                  });
                });
  schema.tables("health_noise",
                "process noise of one health parameter instead of process_noise.health_sigma: parameter, sigma (of one "
                "sample; a fraction, or in the linear model's unit)",
                [&c](const std::string& file, const toml::array& array) {
                  const Names names = names_of(c);
                  for_each_table(file, "health_noise", array, [&](TableReader& t) {
                    const std::size_t parameter = index_of(t, "parameter", names.health);
                    const double most = ProcessNoiseKeys::most_health_sigma * names.health_unit[parameter];
                    c.process_noise_keys.state(parameter, t.real("sigma", 0, most));
                  });
                });
}

void declare_control_changes(Schema& schema, SimConfig& c) {
  schema.tables("control_change",
                "a change of a control of the linear model: time_s, control, change (its unit), ramp_s",
                [&c](const std::string& file, const toml::array& array) {
                  const Names names = names_of(c);
                  if (names.controls.empty())
                    throw ConfigError("'control_change' is for a linear model with controls ('linear.model')");
                  for_each_table(file, "control_change", array, [&](TableReader& t) {
                    const double time_s = t.real("time_s", 0, far_future_s);
                    const std::size_t control = index_of(t, "control", names.controls);
                    c.scenario.control_changes.push_back(
                        {time_s, control, t.real("change", -1e9, 1e9), t.real_or("ramp_s", 0.0, 0, far_future_s)});
                  });
                });
}

void declare_faults(Schema& schema, SimConfig& c) {
  static const std::vector<std::string> kinds{"bias", "drift", "stuck", "dropout", "noise"};
  schema.tables("sensor_fault",
                "a sensor fault: time_s, sensor, kind, magnitude (sensor's unit, per second for drift, factor for "
                "noise), duration_s (0: for good)",
                [&c](const std::string& file, const toml::array& array) {
                  const Names names = names_of(c);
                  for_each_table(file, "sensor_fault", array, [&](TableReader& t) {
                    ScheduledFault f;
                    f.sensor = index_of(t, "sensor", names.sensors);
                    f.fault.kind = static_cast<FaultKind>(1 + index_of(t, "kind", kinds));
                    f.fault.start_s = t.real("time_s", 0, far_future_s);
                    f.fault.duration_s = t.real_or("duration_s", 0.0, 0, far_future_s);
                    f.fault.magnitude = t.real_or("magnitude", 0.0, -1e9, 1e9);
                    c.scenario.faults.push_back(f);
                  });
                });
}

void declare_replay(Schema& schema, ReplayOptions& r) {
  schema.text("replay.file", r.file,
              "a monitor's recording or a CSV file to publish instead of a flight, with its engines and sequences");
  schema.alias("replay.file", "--replay");
  schema.text("replay.column_map", r.column_map,
              "TOML file that says which column of a CSV file is which channel; empty: replay.file is a recording");
  schema.alias("replay.column_map", "--column-map");
  schema.choice("replay.stamps", r.stamps, {"original", "now"},
                "time stamps as recorded, or moved so that the first one is the present");
}

}  // namespace

void declare(Schema& schema, SimConfig& c) {
  Scenario& s = c.scenario;
  schema.integer("engine.id", s.engine_id, 1, 4294967295, "", "key of this engine on the wire");
  schema.integer("engine.source_id", s.source_id, 1, 4294967295, "",
                 "who measures: identifies this source on the wire");
  schema.flag("engine.heat_soak", s.heat_soak,
              "whether gas and metal behind HPC, HPT and LPT exchange heat, so that the gas path settles slowly");
  schema.real("aircraft.customer_bleed_kg_s", s.offtake.customer_bleed_kg_s, 0, most_bleed_kg_s, "kg/s",
              "air taken from the HPC's exit, where the profile says nothing else");
  schema.real("aircraft.power_w", s.offtake.power_w, 0, most_power_w, "W",
              "power taken from the HP shaft, where the profile says nothing else");
  schema.real("run.sample_time_s", s.sample_time_s, 0.001, 1, "s", "time between samples");
  schema.real("run.duration_s", s.duration_s, 0, far_future_s, "s", "simulated time to fly; 0: until stopped");
  schema.integer("run.seed", s.seed, 0, 9007199254740992, "",
                 "of the sensors' noise and of the process noise; the same seed gives the same readings");
  schema.text("run.rate", c.rate,
              "times real time, 0.01 to 1000, or max: as fast as a monitor answers, losing nothing");
  schema.alias("run.rate", "--rate");
  schema.integer("run.lockstep_window", c.lockstep_window, 1, 128, "samples",
                 "how many samples may be unanswered at rate max");
  schema.integer("run.wait_for_monitors", c.wait_for_monitors, 0, 64, "",
                 "start the flight when so many readers of EngineSensors have matched");
  schema.text("linear.model", c.linear_file,
              "a linear model to fly instead of the turbofan: the JSON file that tuner_design reads and writes");
  schema.alias("linear.model", "--linear");
  declare_replay(schema, c.replay);
  schema.real("flight.altitude_m", s.flight.altitude_m, -500, 15000, "m", "pressure altitude at the start");
  schema.real("flight.mach", s.flight.mach, 0, 0.95, "", "flight Mach number at the start");
  schema.real("flight.delta_isa_k", s.flight.delta_isa_k, -60, 60, "K",
              "ambient temperature above the standard atmosphere");
  schema.choice("demand.kind", c.demand_kind,
                {"t40_k", "n1_rpm", "net_thrust_n", "fuel_flow_kg_s", "power_lever_percent"},
                "what demand.value is, for the new engine");
  schema.real("demand.value", s.demand.value, 0, 1e6, "by kind",
              "demand at the start; the control holds the fan speed that it gives; of the power lever 0 is idle, and "
              "100 the limit "
              "of corrected fan speed");
  c.engine_keys.declare(schema, s);
  c.mismatch_keys.declare(schema);
  c.mission_keys.declare(schema);
  c.life_keys.declare(schema);
  c.process_noise_keys.declare(schema);
  schema.integer("dds.domain", c.domain, 0, 232, "", "DDS domain");
  schema.text("dds.partition", c.partition, "DDS partition, fleet/<group>; empty is the default partition");
  schema.text("dds.profiles_file", c.profiles_file, "Fast DDS XML profiles; empty is the built-in UDP profile");
  schema.text("dds.profile", c.profile, "participant profile to take from dds.profiles_file");
  schema.text(
      "dds.security", c.security,
      "directory of certificates and permissions that make_security.sh made; empty: no security, anybody may join");
  schema.flag("dds.security_required", c.security_required, "do not start without dds.security");
  schema.choice("log.level", c.log_level, {"trace", "debug", "info", "warn", "error"}, "least severity that is logged");
  declare_profile(schema, c);
  declare_health(schema, c);
  declare_control_changes(schema, c);
  declare_faults(schema, c);
}

namespace {

/// Wear and changes of one parameter may add up beyond what a single key allows.
void check_health_sum(const Scenario& s, const Names& names) {
  auto changes = s.health_changes;
  std::stable_sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.time_s < b.time_s; });
  std::vector<double> health;
  for (const Wear& wear : s.wear) health.push_back(wear.initial);
  const auto require_in_range = [&](const char* what, std::size_t channel, double time_s) {
    const double least = health_min * names.health_unit[channel], most = health_max * names.health_unit[channel];
    if (!(health[channel] >= least && health[channel] <= most))
      throw ConfigError(std::string(what) + names.health[channel] + " to " + config::number_text(health[channel]) +
                        " at " + config::number_text(time_s) + " s, allowed is " + config::number_text(least) + " to " +
                        config::number_text(most));
  };
  for (std::size_t i = 0; i < names.health.size(); ++i) require_in_range("'wear' and 'life' bring ", i, 0.0);
  for (const auto& c : changes) {
    health[c.channel] += c.change;
    require_in_range("'health_change' brings ", c.channel, c.time_s);
  }
}

void check_profile(const std::vector<ProfilePoint>& p) {
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (!(p[i].time_s > p[i - 1].time_s))
      throw ConfigError("'profile.time_s' is " + config::number_text(p[i].time_s) + " after " +
                        config::number_text(p[i - 1].time_s) + ", allowed are rising times");
    if (p[i].demand.kind != p[i - 1].demand.kind)
      throw ConfigError("'profile' at " + config::number_text(p[i].time_s) +
                        " s changes between n1_rpm and net_thrust_n, allowed is one of them throughout");
  }
}

/// Demands of the power lever as fan speeds of the engine.
void read_levers(SimConfig& c) {
  Scenario& s = c.scenario;
  if (c.demand_kind == "power_lever_percent") {
    if (s.demand.value > 100.0)
      throw ConfigError("'demand.value' is " + config::number_text(s.demand.value) +
                        ", allowed are 0 to 100 percent of the power lever");
    s.demand = demand_of_power_lever(s.engine->data, s.control.limits, s.demand.value, s.flight);
  }
  for (std::size_t i = 0; i < c.profile_levers.size(); ++i) {
    if (c.profile_levers[i].has_value() != c.profile_levers.front().has_value())
      throw ConfigError("'profile' at " + config::number_text(s.profile[i].time_s) +
                        " s changes between power_lever_percent and another demand, allowed is one of them throughout");
    if (c.profile_levers[i])
      s.profile[i].demand =
          demand_of_power_lever(s.engine->data, s.control.limits, *c.profile_levers[i], s.profile[i].flight);
  }
}

}  // namespace

double SimConfig::rate_factor() const {
  if (rate == "max") return 0.0;
  double factor = 0.0;
  const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), factor);
  if (error != std::errc() || end != rate.data() + rate.size() || !(factor >= 0.01 && factor <= 1000.0))
    throw ConfigError("'run.rate' is '" + rate + "', allowed is a number from 0.01 to 1000, or max");
  return factor;
}

void finish_config(SimConfig& c, const Schema& schema) {
  c.rate_factor();
  const Names names = names_of(c);
  if (c.linear)
    check_linear(schema.given());
  else
    c.engine_keys.finish(schema.given(), c.scenario);
  c.scenario.mismatch = c.mismatch_keys.value(schema.given());
  c.scenario.process_noise = c.process_noise_keys.value(schema.given(), shown_units(c, names));
  if (c.replay.file.empty() && !c.replay.column_map.empty())
    throw ConfigError("'replay.column_map' is for 'replay.file', which is not set");
  if (c.security_required && c.security.empty())
    throw ConfigError(
        "'dds.security_required' is true, but 'dds.security' names no directory: set it, or "
        "EHM_DDS_SECURITY, to the identity of this service");
  c.scenario.demand.kind = c.demand_kind == "t40_k"          ? DemandKind::t40_k
                           : c.demand_kind == "n1_rpm"       ? DemandKind::n1_rpm
                           : c.demand_kind == "net_thrust_n" ? DemandKind::net_thrust_n
                                                             : DemandKind::fuel_flow_kg_s;
  if (!c.linear) read_levers(c);
  c.mission_keys.finish(schema.given(), c.scenario);
  if (!c.linear) c.life_keys.finish(c.scenario);
  check_health_sum(c.scenario, names);
  check_profile(c.scenario.profile);
}

}  // namespace ehm::engine_sim
