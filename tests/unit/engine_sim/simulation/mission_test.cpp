// SPDX-License-Identifier: Apache-2.0
// The two-hour mission: the engine flies it, and the air that the aircraft takes is an actuator.

#include "engine_sim/scenario/mission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine_sim/engines/jt9d.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"

namespace ehm::engine_sim {
namespace {

constexpr std::size_t customer_bleed = 3, power_offtake = 4;  ///< among the JT9D's controls

Scenario mission_of(const MissionOptions& options) {
  Scenario s = test::quiet();
  s.heat_soak = true;
  s.sample_time_s = 0.1;
  s.profile = two_hour_mission(s.engine->data, options);
  s.flight = s.profile.front().flight;
  s.demand = s.profile.front().demand;
  return s;
}

TEST(Mission, IsFlownFromTaxiToTaxi) {
  Simulation simulation(mission_of({}));
  const double limit_k = jt9d().ratings.t48_max_k;
  double top_m = 0.0, most_n1_rpm = 0.0, descent_n1_rpm = 1e9;
  while (simulation.time_s() < mission_seconds) {
    const double t = simulation.time_s();
    const EngineSample s = simulation.next_sample();
    top_m = std::max(top_m, s.flight.altitude_m);
    if (t > 430.0 && t < 450.0) most_n1_rpm = std::max(most_n1_rpm, s.sensors[0].value);
    if (t > 5500.0 && t < 6500.0) descent_n1_rpm = std::min(descent_n1_rpm, s.sensors[0].value);
    EXPECT_LT(s.sensors[6].value, 1.01 * limit_k) << t;
    EXPECT_GT(s.auxiliary[3], 0.0) << t;  // the LPC has stall margin left
  }
  EXPECT_DOUBLE_EQ(top_m, 10668.0);
  EXPECT_GT(most_n1_rpm, 3600.0);
  EXPECT_LT(descent_n1_rpm, 0.75 * most_n1_rpm);
}

TEST(Mission, OfftakeIsAKnownActuatorAndCostsWhatTheEngineSays) {
  Scenario with = mission_of({.delta_isa_k = 0.0, .offtake = 1.0}), without = mission_of({.offtake = 0.0});
  // from the first second of the cruise
  for (Scenario* s : {&with, &without}) {
    const ProfilePoint cruise = FlightProfile({}, s->profile).at(2000.0);
    s->profile.clear();
    s->flight = cruise.flight;
    s->demand = cruise.demand;
    s->offtake = cruise.offtake;
  }
  Simulation a(with), b(without);
  EngineSample taken, none;
  for (int k = 0; k < 600; ++k) taken = a.next_sample(), none = b.next_sample();
  EXPECT_DOUBLE_EQ(taken.actuators[customer_bleed], 1.0);
  EXPECT_DOUBLE_EQ(taken.actuators[power_offtake], 80e3);
  EXPECT_EQ(none.actuators[customer_bleed], 0.0);
  // 1 kg/s and 80 kW cost fuel and heat at the same fan speed (2 kg/s alone cost 3.8 % of T48)
  EXPECT_NEAR(taken.sensors[6].value / none.sensors[6].value, 1.019, 0.006);
  EXPECT_GT(taken.actuators[0] / none.actuators[0], 1.015);
}

TEST(Mission, ProfileInterpolatesOfftakeAndHoldsItOutside) {
  const FlightProfile profile({}, {{.time_s = 10.0, .offtake = {1.0, 0.0}}, {.time_s = 20.0, .offtake = {2.0, 1e5}}});
  EXPECT_DOUBLE_EQ(profile.at(15.0).offtake.customer_bleed_kg_s, 1.5);
  EXPECT_DOUBLE_EQ(profile.at(15.0).offtake.power_w, 5e4);
  EXPECT_DOUBLE_EQ(profile.at(0.0).offtake.customer_bleed_kg_s, 1.0);
  EXPECT_DOUBLE_EQ(profile.at(99.0).offtake.power_w, 1e5);
  EXPECT_DOUBLE_EQ(profile.at(20.0).offtake.customer_bleed_kg_s, 2.0);
}

TEST(Mission, ACompressedOneIsAsHighAndFaster) {
  const auto full = two_hour_mission(jt9d(), {}), quick = two_hour_mission(jt9d(), {.time_scale = 0.01});
  ASSERT_EQ(full.size(), quick.size());
  EXPECT_DOUBLE_EQ(full.back().time_s, mission_seconds);
  EXPECT_DOUBLE_EQ(quick.back().time_s, 0.01 * mission_seconds);
  for (std::size_t i = 0; i < full.size(); ++i) EXPECT_EQ(full[i].flight, quick[i].flight);
}

TEST(NoiseOfTheReading, FollowsItFromTaxiToTakeOffWhileNoiseOfTrimStays) {
  for (const NoiseOf kind : {NoiseOf::reading, NoiseOf::trim}) {
    Scenario s = mission_of({});
    s.sensors = {};
    s.sensors.noise_of = kind;
    Simulation simulation(s);
    Scenario quiet = mission_of({});
    Simulation truth(quiet);
    double taxi = 0.0, climb = 0.0, taxi_pa = 0.0, climb_pa = 0.0;
    constexpr std::size_t ps_30 = 4;
    constexpr int samples = 2000;
    while (truth.time_s() < 1100.0) {
      const double t = truth.time_s();
      const double value = truth.next_sample().sensors[ps_30].value;
      const double error = simulation.next_sample().sensors[ps_30].value - value;
      if (t >= 100.0 && t < 300.0) taxi += error * error / samples, taxi_pa += value / samples;
      if (t >= 900.0 && t < 1100.0) climb += error * error / samples, climb_pa += value / samples;
    }
    // 2000 deviates tell a standard deviation to 1.6 %
    const double ratio = std::sqrt(climb / taxi);
    EXPECT_NEAR(ratio, kind == NoiseOf::reading ? climb_pa / taxi_pa : 1.0, 0.1 * ratio);
    EXPECT_GT(climb_pa / taxi_pa, 2.0);
  }
}

}  // namespace
}  // namespace ehm::engine_sim
