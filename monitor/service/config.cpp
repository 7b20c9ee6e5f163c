// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/config.h"

#include <limits>
#include <set>

#include "deploy/runtime/config/table_reader.h"
#include "deploy/runtime/service/listen_address.h"
#include "monitor/design/make_estimator.h"
#include "monitor/shared/engine_estimators.h"

namespace ehm::monitor {

using config::ConfigError;
using config::Schema;
using config::TableReader;

namespace {

constexpr std::int64_t max_id = 4294967295;

void declare_cycle(Schema& schema, CycleOptions& o) {
  auto& c = o.checks;
  schema.integer("checks.source_id", c.source_id, 0, max_id, "",
                 "the only source that is followed, by the source_id of its samples; 0 is the first that speaks");
  schema.real(
      "checks.range_percent", c.range_percent, 1, 1000, "percent of trim",
      "a sensor farther from its trim is out of range; temperatures count from absolute zero, and one percent is "
      "at least a sigma of the sensor's noise and a tenth of what the fleet's health moves it by");
  schema.real("checks.rate_percent", c.rate_percent, 0.1, 1000, "percent of trim",
              "a larger step between two samples is impossible; one percent as for checks.range_percent");
  schema.integer(
      "checks.stuck_samples", c.stuck_samples, 3, 100000, "samples",
      "fewer equal values in a row are never a stuck channel; from how many on follows resolution and noise of "
      "each sensor, or its [[sensor]] table");
  schema.real("checks.gate_sigma", c.gate_sigma, 2, 20, "sigma", "innovation gate: a value outside is not fused");
  schema.integer(
      "checks.bridge_samples", c.bridge_samples, 1, 1000, "samples",
      "bad values in a row that prediction bridges before the sensor is declared faulty; as many bad words of the "
      "flight condition or an actuator are replaced by the last good one");
  schema.integer("checks.requalify_samples", c.requalify_samples, 1, 1000000, "samples",
                 "good values in a row before a faulty sensor is used again");
  schema.real("checks.restart_gap_s", c.restart_gap_s, 0.05, 3600, "s",
              "a longer gap, or a larger jump back in time, restarts the filter");
  schema.real("checks.stale_periods", o.stale_periods, 1.5, 10000, "sample times",
              "without input for so long the engine is STALE");
  auto& v = o.validity;
  schema.real("validity.altitude_m", v.altitude_m, 1, 20000, "m",
              "farther from the design's altitude estimates are withheld");
  schema.real("validity.mach", v.mach, 0.001, 1, "", "farther from the design's Mach number estimates are withheld");
  schema.real("validity.delta_isa_k", v.delta_isa_k, 0.1, 100, "K",
              "farther from the design's ambient temperature estimates are withheld");
  schema.real("validity.actuator_percent", v.actuator_percent, 0.1, 1000, "percent of trim",
              "farther from the design's actuator position estimates are withheld");
  schema.real("validity.vane_deg", v.vane_deg, 0.1, 90, "deg", "the same for an actuator measured in degrees");
  schema.real("validity.bleed_fraction", v.bleed_fraction, 0.001, 1, "",
              "the same for an actuator measured as a fraction of a flow");
  auto& s = o.shift;
  schema.real("shift.window_s", s.window_s, 0.5, 60, "s",
              "a health shift is a change against the estimate so long ago");
  schema.real("shift.persistence_s", s.persistence_s, 0, 60, "s", "and must last so long");
  schema.real("shift.false_alarm_per_hour", s.false_alarm_per_hour, 1e-9, 100, "1/h",
              "rate at which noise alone may raise a health shift");
  auto& f = o.faults;
  schema.real("faults.false_alarm_per_hour", f.false_alarm_per_hour, 1e-9, 100, "1/h",
              "rate at which noise alone may raise an abrupt fault, all sensors and components together");
  schema.real("faults.persistence_s", f.persistence_s, 0, 10, "s", "the same answer so long before it is given");
  schema.real("faults.decide_within_s", f.decide_within_s, 0.1, 60, "s",
              "without a clear answer for so long the fault is called ambiguous");
  schema.real("faults.wrong_name_probability", f.wrong_name_probability, 1e-9, 0.4, "",
              "of calling one sensor another, or a component a sensor; smaller makes more ambiguous");
  schema.real("faults.signature_error", f.signature_error, 0, 0.9, "",
              "share of the evidence that the linear model's error may turn; larger makes more ambiguous");
  schema.real("faults.slow_bias_probability", f.slow_bias_probability, 1e-15, 0.1, "",
              "that the wear of an engine of the fleet alone looks like a slow bias of a sensor");
}

void declare_fleet(Schema& schema, FleetOptions& f) {
  schema.real("fleet.warn_sigma", f.warn_sigma, 3, 30, "sigma of the prior",
              "an estimate farther from nominal than engines of the fleet are raises a warning");
  schema.real("fleet.withhold_sigma", f.withhold_sigma, 3, 1000, "sigma of the prior",
              "still farther out estimates are withheld; not below fleet.warn_sigma");
  schema.real("fleet.persistence_s", f.persistence_s, 0, 60, "s", "so long in a row before either");
}

std::vector<std::string> estimator_names() {
  std::vector<std::string> names;
  for (const design::EstimatorKind& kind : design::estimator_kinds()) names.emplace_back(kind.name);
  return names;
}

void declare_estimators(Schema& schema, EstimatorOptions& o) {
  std::string what;
  for (const design::EstimatorKind& kind : design::estimator_kinds())
    what += (what.empty() ? "" : "; ") + std::string(kind.name) + ": " + kind.description;
  schema.choice("estimator.published", o.published, estimator_names(), "whose estimates are published. " + what);
  schema.text("estimator.shadow", o.shadow,
              "estimators that fly beside it, with commas between; theirs are published as EngineHealth/NAME and "
              "EngineAuxiliary/NAME, and recorded");
  schema.real("estimator.budget_ms", o.budget_ms, 0, 1000, "ms",
              "what one estimator may take for a sample: who takes longer three times in a row rests for 10 s, and the "
              "tuner filter's estimates go out in its place; 0 is without limit");
  schema.real("estimator.memory_s", o.memory_s, 1, 1e7, "s",
              "of gauss_markov: what no sensor sees returns to the fleet's mean within that time; of rls: so long a "
              "reading counts");
  schema.text("estimator.engine", o.engine,
              "of onboard: the engine that it flies, the name of a shipped one or an engine file; empty: the design's");
  schema.choice("estimator.mismatch", o.mismatch, {"none", "build", "all"},
                "of onboard: what it takes the engine to differ by from its file: nothing, its build and heat soak, or "
                "air data and fuel meter as well");
  schema.real("estimator.lag_speed_s", o.lag_speed_s, 0, 10, "s",
              "of onboard: first-order lag of the speeds, where the engine file states none");
  schema.real("estimator.lag_pressure_s", o.lag_pressure_s, 0, 10, "s", "the same of the pressures");
  schema.real("estimator.lag_temperature_s", o.lag_temperature_s, 0, 10, "s", "the same of the temperatures");
  schema.choice("estimator.noise_of", o.noise_of, {"reading", "trim"},
                "of onboard: whether noise is the engine file's percent of the present reading, or the design's sigma");
  std::vector<std::string> others = estimator_names();
  std::erase(others, design::constrained_name);
  schema.choice("estimator.constrained_of", o.constrained_of, others,
                "of constrained: whose health it keeps from improving by itself");
  schema.choice("estimator.constraint", o.constraint, {"projection", "projection_identity", "truncation"},
                "of constrained: the nearest point that is allowed by the estimator's covariance, the nearest one, or "
                "the mean of the truncated Gaussian with its sigma");
  schema.real("estimator.constraint_margin_sigma", o.constraint_margin_sigma, 0, 10, "sigma",
              "of constrained: the bound stays so far behind the estimate; at 0 noise pushes the estimate on");
  schema.flag("estimator.constraint_feeds_back", o.constraint_feeds_back,
              "of constrained: the estimator goes on from the constrained health, and becomes biased the way of wear; "
              "not with tuner, map, wls, scheduled or truncation");
  schema.text("estimator.wear_raises", o.wear_raises,
              "of constrained: health parameters that wear raises, with commas between; empty: flow capacities of "
              "turbines");
}

void declare_nonlinear(Schema& schema, EstimatorOptions& o) {
  schema.real("estimator.health_walk_percent", o.health_walk_percent, 1e-8, 1, "%",
              "of onboard and the nonlinear filters: what a health parameter may change by within 15 ms, standard "
              "deviation; more of it follows faster, knows less, and keeps particles apart");
  schema.integer("estimator.iterations", o.iterations, 1, 20, "", "of iekf: within a sample, at most");
  schema.real("estimator.box_sigma", o.box_sigma, 0.1, 15, "sigma of the prior",
              "of clipped_ekf and cekpf: health parameters are held within so much");
  schema.choice("estimator.sigma_points", o.sigma_points, {"symmetric", "spherical_simplex", "minimal_skew"},
                "of ukf: 2 n + 1 points, or a simplex of n + 2");
  schema.choice("estimator.unscented_form", o.unscented_form, {"additive", "augmented"},
                "of ukf: process noise added, or among the sigma points");
  schema.integer("estimator.particles", o.particles, 2, 5000, "", "of particle, ekpf and cekpf");
  schema.choice(
      "estimator.particle_weights", o.particle_weights, {"likelihood", "ratio"},
      "of ekpf and cekpf: particles weighed by their likelihood alone, which keeps many alive, or by the ratio "
      "of densities, which is Bayes' rule and needs health_walk_percent not far below the sigma");
  schema.choice("estimator.particle_jacobian", o.particle_jacobian, {"shared", "own"},
                "of ekpf and cekpf: one Jacobian for all particles, or one for each");
}

void declare_recording(Schema& schema, MonitorConfig& m) {
  schema.text(
      "record.file", m.record.file,
      "records every sample and its estimates there (HDF5); an existing file is kept, the next free number taken");
  schema.alias("record.file", "--record");
  schema.integer("record.max_mb", m.record.max_mb, 1, 1000000, "MB", "a larger recording goes on in another file");
  schema.integer("record.max_files", m.record.max_files, 2, 9999, "files",
                 "the oldest ones beyond so many are removed");
  schema.text("offline.file", m.offline.file,
              "a recording or CSV file to estimate from without DDS, instead of serving");
  schema.alias("offline.file", "--offline");
  schema.text("offline.out", m.offline.out, "recording to write from offline.file, with its estimates");
  schema.alias("offline.out", "--out");
  schema.text("offline.column_map", m.offline.column_map,
              "TOML file that says which column of a CSV file is which channel; empty: offline.file is a recording");
  schema.alias("offline.column_map", "--column-map");
  schema.flag(
      "offline.all_estimators", m.offline.all_estimators,
      "offline.file is flown by every estimator that the design has the means for, side by side in one recording; "
      "in place of estimator.shadow");
  schema.alias("offline.all_estimators", "--all-estimators");
}

void declare_realtime(Schema& schema, RealtimeOptions& o) {
  schema.choice("realtime.policy", o.policy, {"other", "fifo"},
                "scheduling of the cycle thread; fifo needs a privilege, without it a warning says how to get it");
  schema.integer("realtime.priority", o.priority, 1, 99, "", "of the cycle thread under fifo; 99 is the highest");
  schema.flag("realtime.middleware_threads", o.middleware_threads,
              "the threads of DDS, which receive the samples, are scheduled like the cycle thread");
  schema.text("realtime.cpus", o.cpus, "processors of the cycle thread, such as 0,2-3; empty is all");
  schema.flag("realtime.lock_memory", o.lock_memory,
              "keep the process in memory (mlockall); needs a privilege or limit");
  schema.integer("realtime.prefault_stack_kb", o.prefault_stack_kb, 0, 4096, "kB",
                 "stack of the cycle thread that is touched before it runs");
}

void declare_checkpoint(Schema& schema, MonitorConfig& m) {
  schema.text("checkpoint.directory", m.checkpoint_directory,
              "existing folder for one checkpoint file per engine, from which a killed monitor resumes; empty is none");
  schema.real("checkpoint.period_s", m.checkpoint_period_s, 0.1, 3600, "s", "time between checkpoints of an engine");
  schema.real("checkpoint.max_age_s", m.checkpoint_max_age_s, 0.1, 1e6, "s",
              "an older checkpoint, by our clock or by the source's, is not resumed: the filter starts cold");
}

void declare_history(Schema& schema, HistoryOptions& h) {
  schema.text("history.directory", h.directory,
              "existing folder for what is known of each engine from flight to flight: its baseline, from which "
              "estimator onboard starts, and a line a flight (monitor history ID); empty is none");
  schema.real("history.wear_percent", h.wear_percent, 0, 5, "percent",
              "standard deviation by which a health parameter may wear from one flight to the next");
  schema.integer("history.first_flights", h.first_flights, 1, 1000, "flights",
                 "in which an engine's build is learned; its wear is counted from what they found");
}

void declare_sensors(Schema& schema, MonitorConfig& m) {
  schema.tables("sensor",
                "what is known of one sensor: name, stuck_samples (as many equal values in a row are stuck, 0 is "
                "never; without it "
                "they follow resolution and noise), resolution (step of its values, in the channel's unit)",
                [&m](const std::string& file, const toml::array& array) {
                  for (const auto& element : array) {
                    TableReader t(file, "sensor", *element.as_table());
                    SensorOptions sensor{.name = t.text("name")};
                    if (t.has("stuck_samples")) sensor.stuck_samples = t.integer("stuck_samples", 0, 10'000'000);
                    if (t.has("resolution")) sensor.resolution = t.real("resolution", 0, 1e12);
                    t.finish();
                    if (sensor.stuck_samples == 1)
                      throw ConfigError(config::where(file, element) + ": 'sensor.stuck_samples' for '" + sensor.name +
                                        "' is 1, allowed is 0 (never) or from 2 on");
                    if (sensor.stuck_samples < 0 && sensor.resolution < 0.0)
                      throw ConfigError(config::where(file, element) + ": 'sensor' for '" + sensor.name +
                                        "' needs stuck_samples, resolution or both");
                    for (const auto& other : m.cycle.sensors)
                      if (other.name == sensor.name)
                        throw ConfigError(config::where(file, element) + ": 'sensor.name' names '" + sensor.name +
                                          "' twice; one table is allowed");
                    m.cycle.sensors.push_back(sensor);
                  }
                });
}

void declare_tables(Schema& schema, MonitorConfig& m) {
  schema.tables(
      "engine",
      "which design flies for which engines: ids, design; and, where it is not that of [estimator]: published, shadow",
      [&m](const std::string& file, const toml::array& array) {
        for (const auto& element : array) {
          TableReader t(file, "engine", *element.as_table());
          m.engines.push_back({t.integers("ids", 1, max_id), t.text("design")});
          EngineAssignment& engines = m.engines.back();
          if (t.has("published")) engines.published = t.choice("published", estimator_names());
          if (t.has("shadow")) engines.shadow = t.text("shadow");
          t.finish();
          if (engines.ids.empty())
            throw ConfigError(config::where(file, element) + ": 'engine.ids' is empty, allowed is at least one id");
        }
      });
  schema.tables("limit",
                "an event when an estimate leaves its range: quantity (a health or auxiliary channel), min, max, "
                "hysteresis, in the channel's unit",
                [&m](const std::string& file, const toml::array& array) {
                  constexpr double infinity = std::numeric_limits<double>::infinity();
                  for (const auto& element : array) {
                    TableReader t(file, "limit", *element.as_table());
                    const LimitOptions limit{t.text("quantity"), t.real_or("min", -infinity, -1e12, 1e12),
                                             t.real_or("max", infinity, -1e12, 1e12),
                                             t.real_or("hysteresis", 0.0, 0, 1e12)};
                    t.finish();
                    if (!(limit.min < limit.max) || (limit.min == -infinity && limit.max == infinity))
                      throw ConfigError(config::where(file, element) + ": 'limit' for '" + limit.quantity +
                                        "' needs min, max or both, with min below max");
                    if (!(2.0 * limit.hysteresis < limit.max - limit.min))
                      throw ConfigError(config::where(file, element) + ": 'limit.hysteresis' for '" + limit.quantity +
                                        "' is " + config::number_text(limit.hysteresis) +
                                        ", allowed is less than half of max - min, or it could never clear");
                    for (const auto& other : m.cycle.limits)
                      if (other.quantity == limit.quantity)
                        throw ConfigError(config::where(file, element) + ": 'limit.quantity' names '" + limit.quantity +
                                          "' twice; one limit with min and max is allowed");
                    m.cycle.limits.push_back(limit);
                  }
                });
}

}  // namespace

void declare(Schema& schema, MonitorConfig& m) {
  schema.text("monitor.design", m.design,
              "design file of tuner_design, flown for every engine without an [[engine]] table");
  schema.integer("monitor.source_id", m.source_id, 1, max_id, "", "identifies this monitor on the wire");
  schema.integer("monitor.max_engines", m.max_engines, 1, 1000, "engines",
                 "filters prepared at start; samples of further engines are counted and refused");
  schema.real("monitor.status_period_s", m.status_period_s, 0.05, 60, "s",
              "time between MonitorStatus messages of an engine");
  schema.real("monitor.forget_engine_s", m.forget_engine_s, 0, 1e6, "s",
              "an engine without an [[engine]] table that has been silent for so long gives its filter to others; 0 is "
              "never");
  schema.choice("monitor.clock", m.clock, {"monotonic", "source"},
                "age of the input by our own clock, or by the samples' time stamps (replay, accelerated runs)");
  declare_cycle(schema, m.cycle);
  declare_fleet(schema, m.cycle.fleet);
  declare_estimators(schema, m.cycle.estimator);
  declare_nonlinear(schema, m.cycle.estimator);
  declare_realtime(schema, m.realtime);
  declare_recording(schema, m);
  declare_checkpoint(schema, m);
  declare_history(schema, m.history);
  schema.integer("dds.domain", m.domain, 0, 232, "", "DDS domain");
  schema.text("dds.partition", m.partition, "DDS partition, fleet/<group>; empty is the default partition");
  schema.text("dds.profiles_file", m.profiles_file, "Fast DDS XML profiles; empty is the built-in UDP profile");
  schema.text("dds.profile", m.profile, "participant profile to take from dds.profiles_file");
  schema.text(
      "dds.security", m.security,
      "directory of certificates and permissions that make_security.sh made; empty: no security, anybody may join");
  schema.flag("dds.security_required", m.security_required, "do not start without dds.security");
  schema.choice("dds.ownership", m.ownership, {"shared", "exclusive"},
                "of the estimate topics; exclusive for redundant monitors, and their readers must ask for it");
  schema.integer("dds.ownership_strength", m.ownership_strength, 0, 1000000, "",
                 "of this monitor under exclusive ownership; the strongest live one is seen");
  schema.real(
      "dds.input_deadline_s", m.input_deadline_s, 0, 60, "s",
      "ask sources for a sample of each engine so often (engine_sim offers 0.1) and raise an event when it stays "
      "away; sources that do not offer it are excluded; 0 asks for nothing");
  schema.real("dds.input_lease_s", m.input_lease_s, 0, 60, "s",
              "ask sources for a sign of life so often (engine_sim offers 1) and raise an event when it stays away; "
              "sources that do not offer it are excluded; 0 asks for nothing");
  schema.choice("log.level", m.log_level, {"trace", "debug", "info", "warn", "error"}, "least severity that is logged");
  schema.text("metrics.listen", m.metrics_listen,
              "HOST:PORT of the HTTP endpoint /metrics, /health, /ready; port 0 is any free one, empty is none");
  declare_sensors(schema, m);
  declare_tables(schema, m);
}

void finish_config(const MonitorConfig& m) {
  if (m.design.empty() && m.engines.empty())
    throw ConfigError(
        "no design: set monitor.design (--monitor-design FILE) or an [[engine]] table; tuner_design makes the file");
  try {
    if (!m.metrics_listen.empty()) service::parse_listen_address(m.metrics_listen);
  } catch (const std::invalid_argument& e) {
    throw ConfigError(std::string("'metrics.listen' ") + e.what() + ", empty for none");
  }
  if (m.cycle.fleet.withhold_sigma < m.cycle.fleet.warn_sigma)
    throw ConfigError("'fleet.withhold_sigma' is " + config::number_text(m.cycle.fleet.withhold_sigma) +
                      ", allowed is from fleet.warn_sigma (" + config::number_text(m.cycle.fleet.warn_sigma) + ") on");
  if (m.security_required && m.security.empty())
    throw ConfigError(
        "'dds.security_required' is true, but 'dds.security' names no directory: set it, or "
        "EHM_DDS_SECURITY, to the identity of this service");
  if (m.offline.file.empty() != m.offline.out.empty())
    throw ConfigError("'offline.file' and 'offline.out' need each other: --offline FILE --out FILE");
  if (m.offline.file.empty() && !m.offline.column_map.empty())
    throw ConfigError("'offline.column_map' is for 'offline.file', which is not set");
  if (m.offline.file.empty() && m.offline.all_estimators)
    throw ConfigError("'offline.all_estimators' is for 'offline.file', which is not set: --offline FILE --out FILE");
  const auto require_shadows = [](const std::string& key, const EstimatorOptions& options) {
    try {
      design::shadow_names(options);
    } catch (const std::invalid_argument& e) {
      throw ConfigError(key + ": " + e.what());
    }
  };
  require_shadows("'estimator.shadow'", m.cycle.estimator);
  for (const EngineAssignment& engines : m.engines)
    require_shadows("'engine.shadow' of engine " + std::to_string(engines.ids.front()),
                    options_of(m, engines).estimator);
  std::set<std::int64_t> seen;
  for (const auto& e : m.engines)
    for (const auto id : e.ids)
      if (!seen.insert(id).second)
        throw ConfigError("'engine.ids' names engine " + std::to_string(id) +
                          " twice; one design per engine is allowed");
  if (static_cast<std::int64_t>(seen.size()) > m.max_engines)
    throw ConfigError("[[engine]] tables name " + std::to_string(seen.size()) +
                      " engines, monitor.max_engines allows " + std::to_string(m.max_engines));
  try {
    parse_cpu_list(m.realtime.cpus);
  } catch (const std::invalid_argument& e) {
    throw ConfigError(e.what());
  }
}

}  // namespace ehm::monitor
