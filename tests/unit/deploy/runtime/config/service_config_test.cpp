// SPDX-License-Identifier: Apache-2.0
// The schemas of both services: their files, tables and cross checks.

#include <gmock/gmock.h>

#include "engine_sim/scenario/scenario_file.h"
#include "monitor/service/config.h"
#include "tests/unit/deploy/runtime/config/config_file.h"

namespace {

using namespace ehm;
using test::ConfigFile;
using test::message_of;

engine_sim::SimConfig load_scenario(const std::string& toml) {
  const ConfigFile file(toml);
  engine_sim::SimConfig config;
  config::Schema schema;
  engine_sim::declare(schema, config);
  schema.load(file.path());
  engine_sim::finish_config(config, schema);
  return config;
}

std::string scenario_error(const std::string& toml) {
  const std::string message = message_of<config::ConfigError>([&] { load_scenario(toml); });
  const auto place = message.find(".toml:");
  return place == std::string::npos ? message : message.substr(place + 6);
}

monitor::MonitorConfig load_monitor(const std::string& toml) {
  const ConfigFile file(toml);
  monitor::MonitorConfig config;
  config::Schema schema;
  monitor::declare(schema, config);
  schema.load(file.path());
  monitor::finish_config(config);
  return config;
}

std::string monitor_error(const std::string& toml) {
  const std::string message = message_of<config::ConfigError>([&] { load_monitor(toml); });
  const auto place = message.find(".toml:");
  return place == std::string::npos ? message : message.substr(place + 6);
}

TEST(ScenarioFile, ReadsTheControlAndAThrustProfile) {
  const auto s = load_scenario(R"(
[control]
hold_limits = false
t48_max_k = 1100
flight_idle_n2_corrected_rpm = 6500
[[profile]]
time_s = 0
net_thrust_n = 40000
)")
                     .scenario;
  EXPECT_FALSE(s.control.hold_limits);
  EXPECT_DOUBLE_EQ(s.control.limits.t48_k, 1100.0);
  EXPECT_DOUBLE_EQ(s.control.limits.flight_idle_n2_corrected_rpm, 6500.0);
  EXPECT_EQ(s.profile.at(0).demand.kind, engine_sim::DemandKind::net_thrust_n);
  EXPECT_DOUBLE_EQ(s.profile.at(0).demand.value, 40000.0);
}

TEST(ScenarioFile, RefusesAProfileOfTwoKinds) {
  EXPECT_EQ(scenario_error("[[profile]]\ntime_s = 0\nn1_rpm = 3000\n[[profile]]\ntime_s = 5\nnet_thrust_n = 3e4\n"),
            "'profile' at 5 s changes between n1_rpm and net_thrust_n, allowed is one of them throughout");
  EXPECT_NE(scenario_error("[[profile]]\ntime_s = 0\nn1_rpm = 3000\nnet_thrust_n = 3e4\n"), "");
  EXPECT_NE(scenario_error("[control]\nt48_max_k = 100\n"), "");
}

// Of the JT9D, whose control's limit of corrected fan speed is the lever's whole way.
TEST(ScenarioFile, APowerLeverAsksForFanSpeed) {
  const engine_sim::Scenario s = load_scenario(R"(
[flight]
altitude_m = 0
mach = 0
[demand]
kind = "power_lever_percent"
value = 100
[[profile]]
time_s = 0
power_lever_percent = 100
[[profile]]
time_s = 10
power_lever_percent = 50
[[profile]]
time_s = 20
power_lever_percent = 0
altitude_m = 10668
mach = 0.8
)")
                                     .scenario;
  const double most = s.control.limits.n1_corrected_rpm;
  EXPECT_EQ(s.demand.kind, engine_sim::DemandKind::n1_rpm);
  EXPECT_NEAR(s.demand.value, most, 1e-9 * most);  // on a standard day at rest theta is 1
  EXPECT_NEAR(s.profile.at(0).demand.value, most, 1e-9 * most);
  EXPECT_NEAR(s.profile.at(1).demand.value, 0.56 * most, 1e-9 * most);
  // T0 218.81 K at 35 000 ft, T2 = T0 (1 + 0.2 M^2) = 246.8 K, theta2^1/2 = 0.9255; real gas differs by less than 0.1 %
  EXPECT_NEAR(s.profile.at(2).demand.value, 0.12 * 0.9255 * most, 1e-3 * most);
}

TEST(ScenarioFile, RefusesAPowerLeverBeyondItsWayOrMixedWithOthers) {
  EXPECT_EQ(scenario_error("[demand]\nkind = \"power_lever_percent\"\nvalue = 110\n"),
            "'demand.value' is 110, allowed are 0 to 100 percent of the power lever");
  EXPECT_EQ(scenario_error("[[profile]]\ntime_s = 0\npower_lever_percent = -1\n"),
            "3: 'profile.power_lever_percent' is -1, allowed is a number from 0 to 100");
  EXPECT_EQ(scenario_error("[[profile]]\ntime_s = 0\npower_lever_percent = 40\n"
                           "[[profile]]\ntime_s = 5\nn1_rpm = 3000\n"),
            "'profile' at 5 s changes between power_lever_percent and another demand, allowed is one of them "
            "throughout");
  EXPECT_NE(scenario_error("[[profile]]\ntime_s = 0\npower_lever_percent = 40\nn1_rpm = 3000\n"), "");
}

TEST(ScenarioFile, ReadsWearFaultsAndProfile) {
  const auto config = load_scenario(R"(
[engine]
id = 3
[run]
rate = "max"
[[wear]]
parameter = "hpc_flow"
initial = -0.01
drift_per_hour = -3.6
[[health_change]]
time_s = 10
parameter = "lpt_efficiency"
change = -0.02
[[sensor_fault]]
time_s = 5
sensor = "T48"
kind = "drift"
magnitude = 0.5
[[profile]]
time_s = 0
n1_rpm = 3600
[[profile]]
time_s = 60
n1_rpm = 3500
mach = 0.78
)");
  const engine_sim::Scenario& s = config.scenario;
  EXPECT_EQ(s.engine_id, 3);
  EXPECT_DOUBLE_EQ(config.rate_factor(), 0.0);
  EXPECT_DOUBLE_EQ(s.wear[engine_sim::hpc_flow].initial, -0.01);
  EXPECT_DOUBLE_EQ(s.wear[engine_sim::hpc_flow].drift_per_s, -0.001);
  ASSERT_EQ(s.health_changes.size(), 1u);
  EXPECT_EQ(s.health_changes[0].channel, static_cast<std::size_t>(engine_sim::lpt_efficiency));
  ASSERT_EQ(s.faults.size(), 1u);
  EXPECT_EQ(s.faults[0].sensor, 6u);
  EXPECT_EQ(s.faults[0].fault.kind, engine_sim::FaultKind::drift);
  ASSERT_EQ(s.profile.size(), 2u);
  EXPECT_DOUBLE_EQ(s.profile[0].flight.altitude_m, 10668.0);  // from [flight]
  EXPECT_DOUBLE_EQ(s.profile[1].flight.mach, 0.78);
}

TEST(ScenarioFile, NamesEveryMistake) {
  EXPECT_EQ(scenario_error("[flight]\nmach = 1.2\n"), "2: 'flight.mach' is 1.2, allowed is a number from 0 to 0.95");
  EXPECT_EQ(scenario_error("[[wear]]\nparameter = \"hpc\"\n"),
            "2: 'wear.parameter' is 'hpc', allowed is one of fan_efficiency, fan_flow, lpc_efficiency, lpc_flow, "
            "hpc_efficiency, hpc_flow, hpt_efficiency, hpt_flow, lpt_efficiency, lpt_flow");
  EXPECT_EQ(scenario_error("[[sensor_fault]]\ntime_s = 1\nsensor = \"T48\"\nkind = \"broken\"\n"),
            "4: 'sensor_fault.kind' is 'broken', allowed is one of bias, drift, stuck, dropout, noise");
  EXPECT_EQ(scenario_error("[run]\nrate = \"fast\"\n"),
            "'run.rate' is 'fast', allowed is a number from 0.01 to 1000, or max");
  EXPECT_EQ(scenario_error("[[profile]]\ntime_s = 5\nn1_rpm = 3000\n[[profile]]\ntime_s = 5\nn1_rpm = 3100\n"),
            "'profile.time_s' is 5 after 5, allowed are rising times");
  EXPECT_EQ(scenario_error("[[health_change]]\ntime_s = 1\nparameter = \"fan_flow\"\nchange = -0.2\n"
                           "[[health_change]]\ntime_s = 2\nparameter = \"fan_flow\"\nchange = -0.2\n"),
            "'health_change' brings fan_flow to -0.4 at 2 s, allowed is -0.3 to 0.1");
  EXPECT_EQ(scenario_error("wear = 3\n"), "1: 'wear' must be tables, written [[wear]]");
}

TEST(MonitorConfig, ReadsEnginesAndLimits) {
  const auto config = load_monitor(R"(
[[engine]]
ids = [1, 2]
design = "a.json"
[[limit]]
quantity = "T40"
max = 1380
[[sensor]]
name = "T48"
stuck_samples = 0
resolution = 0.5
)");
  ASSERT_EQ(config.cycle.sensors.size(), 1u);
  EXPECT_EQ(config.cycle.sensors[0], (ehm::monitor::SensorOptions{"T48", 0, 0.5}));
  ASSERT_EQ(config.engines.size(), 1u);
  EXPECT_EQ(config.engines[0].ids.size(), 2u);
  ASSERT_EQ(config.cycle.limits.size(), 1u);
  EXPECT_DOUBLE_EQ(config.cycle.limits[0].max, 1380.0);
}

TEST(MonitorConfig, NamesEveryMistake) {
  EXPECT_EQ(
      monitor_error(""),
      "no design: set monitor.design (--monitor-design FILE) or an [[engine]] table; tuner_design makes the file");
  EXPECT_EQ(monitor_error("[[engine]]\nids = [1]\ndesign = \"a\"\n[[engine]]\nids = [1]\ndesign = \"b\"\n"),
            "'engine.ids' names engine 1 twice; one design per engine is allowed");
  EXPECT_EQ(monitor_error("[[limit]]\nquantity = \"T40\"\n"),
            "1: 'limit' for 'T40' needs min, max or both, with min below max");
  EXPECT_EQ(monitor_error("[[limit]]\nquantity = \"T40\"\nmin = 0\nmax = 1\nhysteresis = 10\n"),
            "1: 'limit.hysteresis' for 'T40' is 10, allowed is less than half of max - min, or it could never clear");
  EXPECT_EQ(monitor_error("[[limit]]\nquantity = \"T40\"\nmax = 1\n[[limit]]\nquantity = \"T40\"\nmax = 2\n"),
            "4: 'limit.quantity' names 'T40' twice; one limit with min and max is allowed");
  EXPECT_EQ(monitor_error("[[sensor]]\nname = \"T48\"\n"),
            "1: 'sensor' for 'T48' needs stuck_samples, resolution or both");
  EXPECT_EQ(monitor_error("[[sensor]]\nname = \"T48\"\nstuck_samples = 1\n"),
            "1: 'sensor.stuck_samples' for 'T48' is 1, allowed is 0 (never) or from 2 on");
  EXPECT_EQ(monitor_error("[[sensor]]\nname = \"T48\"\nresolution = 1\n[[sensor]]\nname = \"T48\"\nresolution = 2\n"),
            "4: 'sensor.name' names 'T48' twice; one table is allowed");
  EXPECT_EQ(monitor_error("[[engine]]\nids = []\ndesign = \"a\"\n"),
            "1: 'engine.ids' is empty, allowed is at least one id");
  EXPECT_THAT(monitor_error("[[engine]]\nids = [1]\ndesign = \"a\"\npublished = \"kalman\"\n"),
              testing::StartsWith("4: 'engine.published' is 'kalman', allowed is one of tuner, "));
  EXPECT_EQ(monitor_error("[[engine]]\nids = [1]\ndesign = \"a\"\nshadow = \"ekf,ekf\"\n"),
            "'engine.shadow' of engine 1: 'ekf' stands twice; allowed is once");
  EXPECT_EQ(monitor_error("[monitor]\nmax_engines = 0\n"),
            "2: 'monitor.max_engines' is 0, allowed is a whole number from 1 to 1000 engines");
  EXPECT_EQ(monitor_error("[dds]\ndomain = 233\n"), "2: 'dds.domain' is 233, allowed is a whole number from 0 to 232");
}

}  // namespace
