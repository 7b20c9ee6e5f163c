// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engine_command/engine_check.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "engine_sim/model/ratings.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {
namespace {

constexpr FlightCondition flights[]{{0.0, 0.0, 0.0},      {0.0, 0.0, 30.0},      {0.0, 0.25, -30.0},
                                    {3000.0, 0.4, 0.0},   {6000.0, 0.6, 0.0},    {10668.0, 0.8, 0.0},
                                    {11000.0, 0.7, 15.0}, {13500.0, 0.85, -20.0}};
constexpr int powers = 6;  // of each condition, idle and maximum among them

std::string place(const FlightCondition& flight, const std::string& power) {
  std::ostringstream text;
  text << flight.altitude_m << " m, Mach " << flight.mach << ", ISA " << std::showpos << flight.delta_isa_k
       << std::noshowpos << " K, " << power;
  return text.str();
}

void check_design(const Turbofan& engine, EngineCheck& check) {
  const DesignPoint& d = engine.data().design;
  try {
    const Operation operation{.flight = d.flight, .offtake = d.offtake};
    const SteadyPoint p = solve_steady(engine, operation, {DemandKind::fuel_flow_kg_s, d.fuel_flow_kg_s});
    check.design = {{"n1_rpm", d.speeds.n1_rpm, p.gas.speeds.n1_rpm},
                    {"n2_rpm", d.speeds.n2_rpm, p.gas.speeds.n2_rpm},
                    {"bypass_ratio", d.unknowns.bypass_ratio, p.unknowns.bypass_ratio},
                    {"r_line_fan", d.unknowns.r_line_fan, p.unknowns.r_line_fan},
                    {"r_line_lpc", d.unknowns.r_line_lpc, p.unknowns.r_line_lpc},
                    {"r_line_hpc", d.unknowns.r_line_hpc, p.unknowns.r_line_hpc},
                    {"pressure_ratio_hpt", d.unknowns.pressure_ratio_hpt, p.unknowns.pressure_ratio_hpt},
                    {"pressure_ratio_lpt", d.unknowns.pressure_ratio_lpt, p.unknowns.pressure_ratio_lpt}};
  } catch (const std::exception& error) {
    check.design_defect = error.what();
  }
}

void note_surge(const GasPath& gas, const std::string& where, EngineCheck& check) {
  for (const auto& [component, margin_percent] : {std::pair{"fan", gas.stall_margin_fan_percent},
                                                  {"LPC", gas.stall_margin_lpc_percent},
                                                  {"HPC", gas.stall_margin_hpc_percent}}) {
    if (margin_percent > 0.0) continue;
    std::ostringstream text;
    text << where << ": stall margin of the " << component << " " << margin_percent << " %";
    check.surging.push_back(text.str());
  }
}

/// The point, if there is one; else the reason is noted.
std::optional<SteadyPoint> flown(const Turbofan& engine, const FlightCondition& flight, const Demand& demand,
                                 const std::string& power, EngineCheck& check) {
  ++check.points;
  try {
    const SteadyPoint point = solve_steady(engine, flight, {}, demand);
    note_surge(point.gas, place(flight, power), check);
    return point;
  } catch (const std::exception& error) {
    check.failed.push_back(place(flight, power) + ": " + error.what());
    return std::nullopt;
  }
}

void check_flight(const Turbofan& engine, const FlightCondition& flight, EngineCheck& check) {
  const Ratings& ratings = engine.data().ratings;
  const double idle_rpm = idle_n2_rpm(ratings, flight, intake(engine.data().inlet, flight).tt_k);
  const auto maximum = flown(engine, flight, {DemandKind::limit_ratio, 1.0}, "maximum", check);
  const auto idle = flown(engine, flight, {DemandKind::n2_rpm, idle_rpm}, "idle", check);
  if (!maximum || !idle) return;
  for (int i = 1; i < powers - 1; ++i) {
    const double share = static_cast<double>(i) / (powers - 1);
    const double n1_rpm = std::lerp(idle->gas.speeds.n1_rpm, maximum->gas.speeds.n1_rpm, share);
    flown(engine, flight, {DemandKind::n1_rpm, n1_rpm}, "n1_rpm " + std::to_string(std::lround(n1_rpm)), check);
  }
}

}  // namespace

bool StatedNumber::holds() const {
  return std::abs(deviation()) <= design_tolerance;
}

bool EngineCheck::passed() const {
  return design_defect.empty() && failed.empty() && surging.empty() &&
         std::all_of(design.begin(), design.end(), [](const StatedNumber& n) { return n.holds(); });
}

EngineCheck check_engine(const EngineData& data) {
  const Turbofan engine(data);
  EngineCheck check;
  check_design(engine, check);
  for (const FlightCondition& flight : flights) check_flight(engine, flight, check);
  return check;
}

}  // namespace ehm::engine_sim
