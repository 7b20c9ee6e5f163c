// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/scenario/mission.h"

#include "engine_sim/model/parts/root_theta.h"

namespace ehm::engine_sim {
namespace {

constexpr double idle = 0.0;
constexpr double below_every_idle_rpm = 500.0;
/// Of the corrected fan speed at the design point, on the ground under load: at 0.43 three worn engines in 100 000 have
/// no stable balance with their bleed valves open (tuner_design study starts).
constexpr double taxi = 0.45;

struct Leg {
  double time_s, altitude_m, mach, share, bleed_kg_s, power_w;
};
constexpr Leg legs[] = {
    {0, 0, 0.0, taxi, 0.3, 50e3},         {400, 0, 0.02, taxi, 0.3, 50e3},      {410, 0, 0.02, taxi, 0.0, 50e3},
    {418, 0, 0.03, 1.02, 0.0, 50e3},      {455, 0, 0.25, 1.02, 0.0, 50e3},      {500, 500, 0.32, 1.02, 0.0, 60e3},
    {520, 700, 0.35, 0.98, 0.8, 70e3},    {560, 1100, 0.38, 0.98, 0.8, 70e3},   {900, 4600, 0.60, 1.00, 1.0, 80e3},
    {1200, 7000, 0.70, 1.01, 1.0, 80e3},  {1500, 9300, 0.79, 1.02, 1.0, 80e3},  {1560, 9449, 0.80, 0.97, 1.0, 80e3},
    {3600, 9449, 0.80, 0.97, 1.0, 80e3},  {3610, 9449, 0.80, 1.02, 1.0, 80e3},  {3760, 10668, 0.80, 1.02, 1.0, 80e3},
    {3780, 10668, 0.80, 0.98, 1.0, 80e3}, {5400, 10668, 0.80, 0.98, 1.0, 80e3}, {5410, 10660, 0.80, idle, 0.6, 60e3},
    {6000, 6500, 0.62, idle, 0.6, 60e3},  {6590, 3000, 0.45, idle, 0.5, 60e3},  {6600, 2950, 0.44, 0.65, 0.5, 60e3},
    {6700, 1900, 0.34, 0.70, 0.5, 60e3},  {6780, 1000, 0.27, 0.60, 0.5, 60e3},  {6790, 900, 0.26, 0.78, 0.5, 60e3},
    {6890, 30, 0.22, 0.74, 0.5, 60e3},    {6900, 0, 0.21, 0.50, 0.3, 50e3},     {6930, 0, 0.03, taxi, 0.3, 50e3},
    {7200, 0, 0.0, taxi, 0.3, 50e3}};

}  // namespace

std::vector<ProfilePoint> two_hour_mission(const EngineData& engine, const MissionOptions& options) {
  const DesignPoint& design = engine.design;
  const double design_n1_corrected_rpm = design.speeds.n1_rpm / root_theta(engine.inlet, design.flight);
  std::vector<ProfilePoint> profile;
  for (const Leg& leg : legs) {
    const FlightCondition flight{leg.altitude_m, leg.mach, options.delta_isa_k};
    const double share = leg.share > 0.5 ? options.power * leg.share : leg.share;
    const double n1_rpm =
        leg.share == idle ? below_every_idle_rpm : share * design_n1_corrected_rpm * root_theta(engine.inlet, flight);
    profile.push_back({options.time_scale * leg.time_s,
                       flight,
                       {DemandKind::n1_rpm, n1_rpm},
                       {options.offtake * leg.bleed_kg_s, options.offtake * leg.power_w}});
  }
  return profile;
}

}  // namespace ehm::engine_sim
