// SPDX-License-Identifier: Apache-2.0
// Phases of a mission whose legs are known, and what must not be taken for a flight.

#include "monitor/flight/flight_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "engine_sim/engines/shipped_engines.h"
#include "engine_sim/scenario/mission.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using idl::FlightPhase;

constexpr double step_s = 0.5;
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// Between the points of the mission, straight; the fan does not fall below ground idle.
class Mission {
 public:
  explicit Mission(double time_scale) {
    const auto engine = engine_sim::named_engine("jt9d");
    points_ = engine_sim::two_hour_mission(engine->data, {.time_scale = time_scale});
    trim_corrected_rpm_ = engine->data.design.speeds.n1_rpm;
  }
  double end_s() const { return points_.back().time_s; }
  double trim_corrected_rpm() const { return trim_corrected_rpm_; }
  FlightChange follow(FlightPath& path, double time_s, double dt_s) const {
    const auto after =
        std::find_if(points_.begin() + 1, points_.end() - 1, [&](const auto& p) { return p.time_s > time_s; });
    const auto before = after - 1;
    const double share = std::clamp((time_s - before->time_s) / (after->time_s - before->time_s), 0.0, 1.0);
    const auto at = [&](double a, double b) { return a + share * (b - a); };
    const double n1_rpm = std::max(1400.0, at(before->demand.value, after->demand.value));
    return path.follow({at(before->flight.altitude_m, after->flight.altitude_m),
                        at(before->flight.mach, after->flight.mach), before->flight.delta_isa_k},
                       n1_rpm, trim_corrected_rpm_, dt_s);
  }

 private:
  std::vector<engine_sim::ProfilePoint> points_;
  double trim_corrected_rpm_ = 0.0;
};

// The legs of two_hours stand in engine_sim/scenario/mission.cpp: power is set from 410 to 418 s, 450 m are reached at
// 496 s, the top of the climb is at 1560 s, cruise until 5400 s but for 150 s of climb, 3000 m at 6590 s.
TEST(FlightPath, NamesThePhasesOfAMission) {
  const Mission mission(1.0);
  FlightPath path;
  std::array<double, 8> phase_s{};
  std::vector<FlightChange> changes;
  std::vector<double> times;
  for (double t = 0.0; t < mission.end_s(); t += step_s) {
    if (const FlightChange change = mission.follow(path, t, step_s); change != FlightChange::none) {
      changes.push_back(change);
      times.push_back(t);
    }
    phase_s[static_cast<std::size_t>(path.phase())] += step_s;
  }
  EXPECT_EQ(changes, (std::vector{FlightChange::took_off, FlightChange::landed}));
  ASSERT_EQ(times.size(), 2u);
  EXPECT_NEAR(times[0], 415.0, 6.0);
  EXPECT_NEAR(times[1], 6918.3, 3.0);  // Mach 0.1 at 6918.3 s
  const auto in = [&](FlightPhase phase) { return phase_s[static_cast<std::size_t>(phase)]; };
  EXPECT_NEAR(in(FlightPhase::taxi), 415.0 + 282.0, 10.0);
  EXPECT_NEAR(in(FlightPhase::take_off), 496.0 - 415.0, 10.0);
  EXPECT_NEAR(in(FlightPhase::climb), (1560.0 - 496.0) + 150.0, 60.0);
  EXPECT_NEAR(in(FlightPhase::cruise), 3840.0 - 150.0, 80.0);
  EXPECT_NEAR(in(FlightPhase::descent), 6590.0 - 5410.0, 40.0);
  EXPECT_NEAR(in(FlightPhase::approach), 6918.0 - 6590.0, 20.0);
}

TEST(FlightPath, ACompressedMissionIsOneFlightToo) {
  const Mission mission(0.1);
  FlightPath path;
  int took_off = 0, landed = 0;
  for (double t = 0.0; t < mission.end_s(); t += 0.015) {
    const FlightChange change = mission.follow(path, t, 0.015);
    took_off += change == FlightChange::took_off;
    landed += change == FlightChange::landed;
  }
  EXPECT_EQ(took_off, 1);
  EXPECT_EQ(landed, 1);
  EXPECT_EQ(path.phase(), FlightPhase::taxi);
}

// N1c by hand: at 11 km and Mach 0.8 T2 = 216.65 (1 + 0.2 0.64) = 244.38 K, sqrt(T2/288.15) = 0.92093.
TEST(FlightPath, CorrectsTheFanSpeedAndLagsIt) {
  FlightPath path;
  path.follow({11000.0, 0.8, 0.0}, 3000.0, 3000.0, step_s);
  EXPECT_NEAR(path.n1_corrected_rpm(), 3000.0 / 0.92093, 0.1);
  EXPECT_EQ(path.eta(), 0.0);
  path.follow({11000.0, 0.8, 0.0}, 3300.0, 3000.0, step_s);
  EXPECT_NEAR(path.eta(), std::log(1.1) * std::exp(-step_s / 25.0), 1e-9);
  for (int i = 0; i < 1000; ++i) path.follow({11000.0, 0.8, 0.0}, 3300.0, 3000.0, step_s);
  EXPECT_NEAR(path.eta(), 0.0, 1e-6);
  path.follow({11000.0, 0.8, 0.0}, not_measured, 3000.0, step_s);
  EXPECT_NEAR(path.n1_corrected_rpm(), 3300.0 / 0.92093, 0.1);
}

TEST(FlightPath, ARejectedTakeOffIsNoFlight) {
  FlightPath path;
  const auto stay = [&](double mach, double n1_rpm, double seconds) {
    std::vector<FlightChange> changes;
    for (double t = 0.0; t < seconds; t += step_s)
      if (const FlightChange c = path.follow({0.0, mach, 0.0}, n1_rpm, 3000.0, step_s); c != FlightChange::none)
        changes.push_back(c);
    return changes;
  };
  EXPECT_TRUE(stay(0.0, 1400.0, 60.0).empty());
  EXPECT_EQ(stay(0.05, 2900.0, 5.0), std::vector{FlightChange::took_off});
  EXPECT_TRUE(stay(0.18, 2900.0, 10.0).empty());
  EXPECT_EQ(path.phase(), FlightPhase::take_off);
  EXPECT_EQ(stay(0.05, 1400.0, 60.0), std::vector{FlightChange::rejected});
  EXPECT_EQ(path.phase(), FlightPhase::taxi);
}

TEST(FlightPath, WhoIsFirstHeardOfInTheAirHasTakenOff) {
  FlightPath path;
  EXPECT_EQ(path.follow({10668.0, 0.8, 0.0}, not_measured, 0.0, step_s), FlightChange::took_off);
  EXPECT_EQ(path.phase(), FlightPhase::cruise);
  EXPECT_TRUE(path.in_flight());
}

// A word of zero for less than a second is no landing, and what is no number changes nothing.
TEST(FlightPath, AWrongMachNumberIsNoLanding) {
  FlightPath path;
  path.follow({10668.0, 0.8, 0.0}, 3000.0, 3000.0, 0.015);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(path.follow({10668.0, 0.0, 0.0}, 3000.0, 3000.0, 0.015), FlightChange::none);
  for (int i = 0; i < 60; ++i)
    EXPECT_EQ(path.follow({10668.0, not_measured, 0.0}, 3000.0, 3000.0, 0.015), FlightChange::none);
  for (int i = 0; i < 60; ++i) EXPECT_EQ(path.follow({10668.0, 0.8, 0.0}, 3000.0, 3000.0, 0.015), FlightChange::none);
  EXPECT_TRUE(path.in_flight());
}

TEST(FlightPath, BeyondTheAtmosphereThereIsNoFanSpeed) {
  FlightPath path;
  path.follow({30000.0, 0.8, 0.0}, 3000.0, 3000.0, step_s);
  EXPECT_EQ(path.n1_corrected_rpm(), 0.0);
}

}  // namespace
