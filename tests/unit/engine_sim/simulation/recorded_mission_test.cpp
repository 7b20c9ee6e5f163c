// SPDX-License-Identifier: Apache-2.0
// A recorded flight as this engine's mission: what its columns mean, and what is wrong in one.

#include "engine_sim/scenario/recorded_mission.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "deploy/runtime/files/file_error.h"
#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/model/parts/root_theta.h"
#include "tests/temporary_folder.h"
#include "tests/unit/engine_sim/simulation/quiet_flight.h"

namespace ehm::engine_sim {
namespace {

using testing::HasSubstr;

class RecordedMission : public testing::Test {
 protected:
  std::vector<ProfilePoint> of(const std::string& table, const MissionOptions& options = {}) {
    return recorded_mission(folder_.file("flight.csv", table), *engine_, options);
  }
  std::string refusal(const std::string& table) {
    try {
      of(table);
    } catch (const files::FileError& error) {
      return error.what();
    }
    return "";
  }
  double share(const ProfilePoint& p) const {
    const DesignPoint& design = engine_->data.design;
    return p.demand.value / root_theta(engine_->data.inlet, p.flight) * root_theta(engine_->data.inlet, design.flight) /
           design.speeds.n1_rpm;
  }
  test::TemporaryFolder folder_;
  std::shared_ptr<const EngineDefinition> engine_ = named_engine("jt9d");
};

TEST_F(RecordedMission, FanSpeedsAndUnitsAreTaken) {
  const auto profile =
      of("time_s,altitude_ft,true_airspeed_kt,n1_rpm\n100,0,0,1600\n110,1000,300,3500\n", {.time_scale = 0.5});
  ASSERT_EQ(profile.size(), 2u);
  EXPECT_EQ(profile[0].time_s, 0.0);
  EXPECT_EQ(profile[1].time_s, 5.0);
  EXPECT_NEAR(profile[1].flight.altitude_m, 304.8, 1e-9);
  EXPECT_NEAR(profile[1].flight.mach, 300.0 * 1852.0 / 3600.0 / 339.12, 2e-4);  // a at 1000 ft: ISO 2533
  EXPECT_EQ(profile[1].demand.value, 3500.0);
}

// Of another engine's fuel flow only the share counts: the greatest is this engine's take-off, nothing is taxi.
TEST_F(RecordedMission, AFuelFlowIsFlownByItsShare) {
  const auto profile = of("time_s,altitude_m,mach,fuel_flow_kg_h\n0,0,0,0\n10,0,0.1,4000\n20,0,0.1,1000\n");
  ASSERT_EQ(profile.size(), 3u);
  EXPECT_NEAR(share(profile[0]), 0.45, 1e-6);
  EXPECT_NEAR(share(profile[1]), 1.02, 1e-3);
  EXPECT_GT(share(profile[2]), 0.55);
  EXPECT_LT(share(profile[2]), 0.85);
}

TEST_F(RecordedMission, PointsAreMeansOfFiveSeconds) {
  std::string table = "time_s,altitude_m,mach,n1_rpm\n";
  for (int t = 0; t <= 100; ++t) table += std::to_string(t) + ",0,0.1," + (t % 2 == 0 ? "3000" : "3200") + "\n";
  const auto profile = of(table);
  EXPECT_LT(profile.size(), 25u);
  for (std::size_t i = 1; i < profile.size(); ++i) EXPECT_NEAR(profile[i].demand.value, 3100.0, 25.0) << i;
}

TEST_F(RecordedMission, WhatIsWrongIsNamed) {
  EXPECT_THAT(refusal("time_s,altitude_m,n1_rpm\n0,0,3000\n5,0,3000\n"),
              HasSubstr("has no column mach, true_airspeed_m_s"));
  EXPECT_THAT(refusal("time_s,altitude_m,mach,n1_rpm\n0,0,0,3000\n0,0,0,3000\n"),
              testing::AllOf(HasSubstr("flight.csv:3"), HasSubstr("time_s is 0, allowed is later than 0")));
  EXPECT_THAT(refusal("time_s,altitude_m,mach,n1_rpm\n0,0,0,3000\n5,0,1.4,3000\n"),
              testing::AllOf(HasSubstr("flight.csv:3"), HasSubstr("Mach 1.4")));
  EXPECT_THAT(refusal("time_s,altitude_m,mach,n1_rpm\n0,0,0,idle\n"),
              HasSubstr("n1_rpm is 'idle', allowed is a number"));
  EXPECT_THAT(refusal("time_s,altitude_m,mach,n1_rpm\n0,0,0,-5\n"), HasSubstr("is -5, allowed is 0 or more"));
  EXPECT_THAT(refusal("time_s,altitude_m,mach,fuel_flow_kg_h\n0,0,0,0\n5,0,0,0\n"), HasSubstr("no fuel is burnt"));
}

// A real flight of an A320 (openap), where the reference data are at hand.
TEST_F(RecordedMission, ARealFlightIsFlownFromGateToGate) {
  const std::string file = EHM_REFERENCE_DIR "/a320_flight_profile.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "no reference data";
  Scenario s = test::quiet();
  s.heat_soak = true;
  s.sample_time_s = 0.1;
  s.profile = recorded_mission(file, *engine_, {});
  s.flight = s.profile.front().flight;
  s.demand = s.profile.front().demand;
  Simulation simulation(s);
  double top_m = 0.0, most_k = 0.0, least_margin = 1e9;
  while (simulation.time_s() < s.profile.back().time_s) {
    const EngineSample sample = simulation.next_sample();
    top_m = std::max(top_m, sample.flight.altitude_m);
    most_k = std::max(most_k, sample.sensors[6].value);
    least_margin = std::min(least_margin, sample.auxiliary[3]);
  }
  EXPECT_NEAR(top_m, 10060.0, 60.0);
  EXPECT_LT(most_k, 1.01 * engine_->data.ratings.t48_max_k);
  EXPECT_GT(least_margin, 0.0);
  EXPECT_NEAR(s.profile.back().time_s, 7795.0, 6.0);
}

}  // namespace
}  // namespace ehm::engine_sim
