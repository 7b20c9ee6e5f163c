// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/dds/apply_command.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "idl/wire_values.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using idl::SensorFaultKind;
using idl::SimCommandKind;
using test::fly;
using test::quiet;
using testing::HasSubstr;
using testing::StartsWith;

SimCommand command(SimCommandKind kind, std::uint32_t channel, double first, double second = 0.0) {
  SimCommand c;
  c.engine_id(7);
  c.schema(idl::schema_version);
  c.kind(static_cast<std::uint32_t>(kind));
  c.channel(channel);
  c.request(4711);
  c.value() = {first, second, 0.0, 0.0};
  return c;
}

SimCommand fault(std::uint32_t sensor, SensorFaultKind kind, double magnitude, double duration_s = 0.0) {
  SimCommand c = command(SimCommandKind::sensor_fault, sensor, magnitude, duration_s);
  c.fault(static_cast<std::uint32_t>(kind));
  return c;
}

class ApplyCommandTest : public testing::Test {
 protected:
  /// What was done; a refusal fails the test.
  std::string done(const SimCommand& c) {
    const CommandReply reply = apply(c, simulation_);
    EXPECT_EQ(reply.accepted(), 1u) << reply.message().c_str();
    return reply.message().c_str();
  }
  std::string refused(const SimCommand& c) {
    const CommandReply reply = apply(c, simulation_);
    EXPECT_EQ(reply.accepted(), 0u) << reply.message().c_str();
    return reply.message().c_str();
  }
  Simulation simulation_{quiet()};
};

TEST_F(ApplyCommandTest, ChangesDemandHealthAndSensors) {
  const double n1_rpm = simulation_.next().readings[0].value;
  EXPECT_THAT(done(command(SimCommandKind::set_demand, 0, 3200)),
              testing::StrEq("fan speed demand 3200 rpm, from 0.015 s of the flight on"));
  EXPECT_THAT(done(command(SimCommandKind::add_health, hpc_flow, -0.01)),
              StartsWith("hpc_flow by -0.01 (fraction) at once"));
  EXPECT_THAT(done(fault(3, SensorFaultKind::dropout, 0.0)), StartsWith("T24: dropout until cleared"));
  const SimSample after = fly(simulation_, 1000);
  ASSERT_GT(std::abs(n1_rpm - 3200), 10);
  EXPECT_NEAR(after.readings[0].value, 3200, 0.002 * 3200);
  EXPECT_DOUBLE_EQ(after.health[hpc_flow], -0.01);
  EXPECT_FALSE(after.readings[3].valid);
  EXPECT_THAT(done(command(SimCommandKind::clear_faults, 0, 0.0)), StartsWith("no fault of any sensor"));
  EXPECT_TRUE(simulation_.next().readings[3].valid);
}

TEST_F(ApplyCommandTest, SaysEachFaultInItsUnit) {
  EXPECT_THAT(done(fault(6, SensorFaultKind::bias, 10, 5)), StartsWith("T48: bias of +10 K for 5 s, from 0.000 s"));
  EXPECT_THAT(done(fault(2, SensorFaultKind::drift, -20)), StartsWith("P24: drift of -20 Pa/s until cleared"));
  EXPECT_THAT(done(fault(0, SensorFaultKind::noise, 4)), StartsWith("Nf: noise times 4 until cleared"));
  EXPECT_THAT(done(fault(1, SensorFaultKind::stuck, 0)), StartsWith("Nc: stuck at its last value until cleared"));
  EXPECT_THAT(done(fault(1, SensorFaultKind::none, 0)), StartsWith("Nc: no fault"));
}

TEST_F(ApplyCommandTest, AnswersBearTheOrdersNumbers) {
  const CommandReply reply = apply(command(SimCommandKind::set_demand, 0, 3200), simulation_);
  EXPECT_EQ(reply.engine_id(), 7u);
  EXPECT_EQ(reply.request(), 4711u);
  EXPECT_EQ(reply.kind(), static_cast<std::uint32_t>(SimCommandKind::set_demand));
  EXPECT_EQ(reply.role(), static_cast<std::uint32_t>(idl::DescriptionRole::source));
  EXPECT_EQ(reply.schema(), idl::schema_version);
}

TEST_F(ApplyCommandTest, ThrustIsADemandWithinReach) {
  const double thrust_n = 0.9 * simulation_.next().auxiliary[2];
  done(command(SimCommandKind::set_thrust, 0, thrust_n));
  EXPECT_NEAR(fly(simulation_, 1000).auxiliary[2], thrust_n, 1e-3 * thrust_n);  // a new engine gives what is asked
  const double most_n = simulation_.most_net_thrust_n();
  ASSERT_GT(most_n, thrust_n);
  EXPECT_THAT(
      refused(command(SimCommandKind::set_thrust, 0, 1.01 * most_n)),
      HasSubstr("but at its limit of fan speed the engine gives " + std::to_string(std::lround(most_n)) + " here"));
  EXPECT_NEAR(fly(simulation_, 100).auxiliary[2], thrust_n, 1e-3 * thrust_n) << "what is refused changes nothing";
  done(command(SimCommandKind::set_thrust, 0, 0.999 * most_n));
}

TEST_F(ApplyCommandTest, RefusesWhatIsOutOfRange) {
  SimCommand c = command(static_cast<SimCommandKind>(9), 0, 0.0);
  EXPECT_EQ(refused(c), "kind is 9, allowed is 1 to 7 (idl/wire_values.h)");
  EXPECT_EQ(refused(command(SimCommandKind::set_demand, 0, 0.0)), "value[0] (n1_rpm) is 0, allowed is 500 to 30000");
  EXPECT_EQ(refused(command(SimCommandKind::set_demand, 0, std::nan(""))),
            "value[0] (n1_rpm) is nan, allowed is 500 to 30000");
  EXPECT_EQ(refused(command(SimCommandKind::set_health, 10, 0.0)),
            "channel (health parameter) is 10, allowed is 0 to 9");
  EXPECT_EQ(refused(command(SimCommandKind::set_health, 0, -0.5)),
            "fan_efficiency after the command is -0.5, allowed is -0.3 to 0.1");
  EXPECT_EQ(refused(fault(7, SensorFaultKind::bias, 1)), "channel (sensor) is 7, allowed is 0 to 6");
  EXPECT_EQ(refused(fault(0, static_cast<SensorFaultKind>(6), 1)), "fault is 6, allowed is 0 to 5");
  EXPECT_EQ(refused(fault(0, SensorFaultKind::bias, INFINITY)),
            "value[0] (magnitude) is inf, allowed is -1000000000 to 1000000000");
  EXPECT_EQ(refused(fault(0, SensorFaultKind::noise, -1)), "value[0] (magnitude) is -1, allowed is 0 to 1000000000");
  EXPECT_EQ(refused(command(SimCommandKind::set_flight, 0, 10668, 2.0)), "value[1] (mach) is 2, allowed is 0 to 0.95");
  c.schema(2);
  EXPECT_EQ(refused(c), "schema is 2, allowed is 1 to 1");
}

// Simulation.SurvivesEveryWearThatItSaysItCan counts such orders.
TEST_F(ApplyCommandTest, RefusesWhatTheEngineDoesNotSurvive) {
  for (std::uint32_t parameter = 0; parameter < health_count; ++parameter) {
    if (simulation_.can_wear(parameter, -0.30, 0.0)) continue;
    EXPECT_THAT(refused(command(SimCommandKind::set_health, parameter, -0.30)),
                HasSubstr("the engine does not survive " + std::string(health_names[parameter]) +
                          " of -0.3 at its present power"));
    EXPECT_DOUBLE_EQ(fly(simulation_, 10).health[parameter], 0.0);
    return;
  }
  FAIL() << "every wear is survived";
}

}  // namespace
