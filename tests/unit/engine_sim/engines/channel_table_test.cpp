// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/channel_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "engine_sim/engines/jt9d_engine.h"
#include "engine_sim/model/solve/steady.h"
#include "engine_sim/model/units.h"

namespace {

using namespace ehm::engine_sim;

GasPath cruise() {
  static const GasPath gas =
      solve_steady(Turbofan(jt9d_engine().data), {10668.0, 0.8, 0.0}, {}, {DemandKind::t40_k, 1308.6}).gas;
  return gas;
}

double read(const char* name) {
  return find_output(name)->read(cruise(), jt9d_engine().data.ratings);
}

TEST(ChannelTable, NamesAndColumnsAreUnique) {
  std::set<std::string_view> names, columns;
  for (const OutputChannel& channel : output_channels()) {
    EXPECT_TRUE(names.insert(channel.name).second) << channel.name;
    EXPECT_TRUE(channel.column.empty() || columns.insert(channel.column).second) << channel.column;
    EXPECT_LE(channel.name.size(), 63u);  // idl/engine_health.idl
    EXPECT_LE(channel.unit.size(), 31u);
    EXPECT_FALSE(channel.description.empty()) << channel.name;
  }
  for (const ControlChannel& channel : control_channels()) EXPECT_TRUE(names.insert(channel.name).second);
}

// The names that are on the wire since its first day.
TEST(ChannelTable, TheNamesOfTheWireReadWhatTheyAlwaysRead) {
  const GasPath g = cruise();
  EXPECT_EQ(read("Nf"), g.speeds.n1_rpm);
  EXPECT_EQ(read("Nc"), g.speeds.n2_rpm);
  EXPECT_EQ(read("P24"), g.s24.pt_pa);
  EXPECT_EQ(read("T24"), g.s24.tt_k);
  EXPECT_EQ(read("Ps30"), g.ps_30_pa);
  EXPECT_EQ(read("T30"), g.s30.tt_k);
  EXPECT_EQ(read("T48"), g.s48.tt_k);
  EXPECT_EQ(read("T40"), g.s40.tt_k);
  EXPECT_EQ(read("T50"), g.s50.tt_k);
  EXPECT_EQ(read("Fn"), g.net_thrust_n);
  EXPECT_EQ(read("SmLPC"), g.stall_margin_lpc_percent);
}

TEST(ChannelTable, DerivedQuantitiesFollowTheirDefinition) {
  const GasPath g = cruise();
  EXPECT_DOUBLE_EQ(read("BPR"), read("W13") / read("W21"));
  EXPECT_DOUBLE_EQ(read("OPR"), read("P30") / read("P2"));
  EXPECT_DOUBLE_EQ(read("EGTM"), 1270.0 - g.s48.tt_k);  // T48 rating of jt9d.cpp
  EXPECT_DOUBLE_EQ(read("NfR"), g.speeds.n1_rpm / std::sqrt(g.s2.tt_k * rankine_per_kelvin / 518.67));
  EXPECT_DOUBLE_EQ(read("NcR"), g.speeds.n2_rpm / std::sqrt(g.s2.tt_k * rankine_per_kelvin / 518.67));
  // mass: what enters leaves, but for the bleeds that this point has none of
  EXPECT_NEAR(read("W50"), read("W21") + read("Wf"), 1e-9);
  EXPECT_NEAR(read("W2"), read("W13") + read("W21"), 1e-9);
  // without heat soak the metal has the gas temperature
  EXPECT_EQ(read("Tm_hpc"), read("T30"));
  EXPECT_EQ(read("Tm_hpt"), read("T48"));
  EXPECT_EQ(read("Tm_lpt"), read("T50"));
}

TEST(ChannelTable, MetalTemperaturesAreThoseThatWereGiven) {
  const EngineData& data = jt9d_engine().data;
  const Turbofan engine(data);
  const SteadyPoint point = solve_steady(engine, {10668.0, 0.8, 0.0}, {}, {DemandKind::t40_k, 1308.6});
  FlowUnknowns unknowns = point.unknowns;
  const MetalTemperatures metal{600.0, 1000.0, 650.0};
  const GasPath gas = engine.gas_path(point.operation, point.gas.speeds, unknowns, &metal);
  EXPECT_EQ(find_output("Tm_hpt")->read(gas, data.ratings), 1000.0);
  EXPECT_NE(find_output("T48")->read(gas, data.ratings), 1000.0);
}

TEST(ChannelTable, ControlsSetWhatTheyName) {
  Operation operation;
  for (const ControlChannel& channel : control_channels()) channel.of(operation) = channel.highest;
  EXPECT_EQ(operation.fuel_flow_kg_s, 100.0);
  EXPECT_EQ(operation.geometry.vsv_deg, 40.0);
  EXPECT_EQ(operation.geometry.vbv_fraction, 0.5);
  EXPECT_EQ(operation.geometry.core_nozzle_area_ratio, 2.0);
  EXPECT_NO_THROW(require_valid(operation));  // the ranges are the gas path's own
  for (const ControlChannel& channel : control_channels()) {
    if (channel.name == "fuel_flow") continue;  // the model has no upper limit of fuel
    Operation beyond = operation;
    channel.of(beyond) = std::nextafter(channel.highest, 1e9);
    EXPECT_THROW(require_valid(beyond), std::invalid_argument) << channel.name;
  }
}

TEST(ChannelTable, AnUnknownNameIsNone) {
  EXPECT_EQ(find_output("P25"), nullptr);
  EXPECT_EQ(find_output(""), nullptr);
  EXPECT_EQ(find_control("Nf"), nullptr);
  EXPECT_EQ(find_health("fan"), health_count);
  EXPECT_EQ(find_health("hpc_flow"), hpc_flow);
}

}  // namespace
