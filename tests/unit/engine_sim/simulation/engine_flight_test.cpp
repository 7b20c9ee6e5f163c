// SPDX-License-Identifier: Apache-2.0
// Another engine than the default one flies, with the channels that its file names.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/model/ratings.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"

namespace {

using namespace ehm::engine_sim;
using ehm::test::fly;
using ehm::test::quiet;
using testing::ElementsAre;

Scenario of(std::shared_ptr<const EngineDefinition> engine) {
  Scenario s = quiet();
  s.control = engine->control;
  s.engine = std::move(engine);
  return s;
}

std::vector<std::string> names(const std::vector<EngineChannel>& channels) {
  std::vector<std::string> list;
  for (const EngineChannel& channel : channels) list.push_back(channel.name);
  return list;
}

TEST(EngineFlight, TheWireHasTheChannelsOfTheFile) {
  Scenario s = of(named_engine("high_bypass"));
  s.sensors = {};
  Simulation simulation(s);
  const EngineChannels& c = simulation.channels();
  EXPECT_EQ(c.engine_type, "high-bypass-turbofan");
  EXPECT_THAT(names(c.sensors), ElementsAre("Nf", "Nc", "P13", "P24", "T24", "Ps30", "T30", "T48"));
  EXPECT_THAT(names(c.auxiliary), ElementsAre("T40", "T50", "Fn", "SmHPC", "EGTM"));
  EXPECT_THAT(names(c.actuators), ElementsAre("fuel_flow", "VSV", "VBV", "customer_bleed", "power_offtake"));
  EXPECT_DOUBLE_EQ(c.sensors[2].trim, simulation.nominal().s13.pt_pa);
  EXPECT_DOUBLE_EQ(c.sensors[2].sigma, 0.005 * simulation.nominal().s13.pt_pa);
  EXPECT_DOUBLE_EQ(c.auxiliary[4].trim, 1300.0 - simulation.nominal().s48.tt_k);  // its T48 rating
  const EngineSample sample = simulation.next_sample();
  EXPECT_EQ(sample.sensors.size(), 8u);
  EXPECT_EQ(sample.auxiliary.size(), 5u);
}

// Order, subset and all else that a file may choose.
TEST(EngineFlight, TheOrderIsTheFiles) {
  auto engine = std::make_shared<EngineDefinition>(jt9d_engine());
  engine->channels.sensors = {{find_output("T48"), 0.0}, {find_output("W2"), 0.0, 0.0, 10.0}};
  engine->channels.auxiliary = {find_output("Tm_hpt")};
  engine->channels.controls = {find_control("VBV"), find_control("fuel_flow")};
  engine->channels.health = {{hpt_flow, 0.01}, {fan_flow, 0.02}};
  Scenario s = of(engine);
  s.heat_soak = true;
  Simulation simulation(s);
  simulation.order_health(1, -0.02, 0.0);  // the second channel: the fan's flow
  simulation.next_sample();
  const EngineSample sample = simulation.next_sample();
  EXPECT_THAT(sample.health, ElementsAre(0.0, -0.02));
  EXPECT_EQ(simulation.health_of(1), -0.02);
  EXPECT_NEAR(sample.sensors[0].value, simulation.nominal().s48.tt_k, 5.0);
  EXPECT_EQ(std::fmod(sample.sensors[1].value, 10.0), 0.0);  // in steps of 10 kg/s
  EXPECT_NEAR(sample.sensors[1].value, 0.98 * simulation.nominal().s2.w_kg_s, 10.0);
  EXPECT_NEAR(sample.auxiliary[0], simulation.nominal().s48.tt_k, 1.0);  // the metal is slow
  EXPECT_EQ(sample.actuators[0], 0.0);
  EXPECT_GT(sample.actuators[1], 0.5);
}

// Its control: from idle to the most thrust and back, at sea level and at cruise; no limit passed, nothing stalls.
TEST(EngineFlight, TheSecondEngineAcceleratesAndDecelerates) {
  for (const FlightCondition& flight : {FlightCondition{0.0, 0.0, 0.0}, FlightCondition{10668.0, 0.8, 0.0}}) {
    const auto definition = named_engine("high_bypass");
    const Turbofan turbofan(definition->data);
    const Ratings& ratings = definition->data.ratings;
    ControlledEngine engine(turbofan, definition->control,
                            settled(turbofan, definition->control, {flight, {}, {}}, 3500.0));
    double least_margin = 100.0, most_ratio = 0.0, highest_rpm = 0.0, lowest_rpm = 1e9;
    for (int k = 0; k < 6000; ++k) {
      const double demand_rpm = (k / 1500) % 2 == 0 ? 10'000.0 : 500.0;
      const ControlledSample sample = engine.step({flight, {}, {}}, demand_rpm, 0.015);
      const GasPath& g = sample.gas;
      least_margin =
          std::min({least_margin, g.stall_margin_fan_percent, g.stall_margin_lpc_percent, g.stall_margin_hpc_percent});
      most_ratio = std::max(
          most_ratio, limit_ratio(ratings, 0.0, g.s48.tt_k, g.s30.pt_pa, g.speeds.n1_rpm, g.speeds.n2_rpm, g.s2.tt_k));
      highest_rpm = std::max(highest_rpm, g.speeds.n1_rpm);
      lowest_rpm = std::min(lowest_rpm, g.speeds.n1_rpm);
    }
    EXPECT_GT(least_margin, 0.0) << flight.altitude_m;
    EXPECT_LT(most_ratio, 1.01) << flight.altitude_m;
    EXPECT_GT(highest_rpm, 1.3 * lowest_rpm) << flight.altitude_m;
  }
}

}  // namespace
