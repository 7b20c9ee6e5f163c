// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/mismatch/mismatch.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/noise_source.h"

namespace ehm::engine_sim {
namespace {

using enum MismatchGroup;

constexpr std::array<MismatchCause, mismatch_count> causes{{
    {"core_nozzle_area", "fraction", "area of the core nozzle", build, 0.003,
     [](EngineData& e, double v) { e.core_nozzle.area_m2 *= 1.0 + v; }, nullptr},
    {"bypass_nozzle_area", "fraction", "area of the bypass nozzle", build, 0.003,
     [](EngineData& e, double v) { e.bypass_nozzle.area_m2 *= 1.0 + v; }, nullptr},
    {"hpt_cooling", "fraction", "cooling air of the HPT", build, 0.03,
     [](EngineData& e, double v) {
       e.air.hpt_inlet *= 1.0 + v;
       e.air.hpt_exit *= 1.0 + v;
     },
     nullptr},
    {"lpt_cooling", "fraction", "cooling air of the LPT", build, 0.03,
     [](EngineData& e, double v) {
       e.air.lpt_inlet *= 1.0 + v;
       e.air.lpt_exit *= 1.0 + v;
     },
     nullptr},
    {"heating_value", "fraction", "lower heating value of the fuel", build, 0.003,
     [](EngineData& e, double v) { e.combustor.lower_heating_value_j_kg *= 1.0 + v; }, nullptr},
    {"burner_pressure_loss", "fraction", "pressure loss of the burner, of itself", build, 0.05,
     [](EngineData& e, double v) { e.combustor.pressure_loss *= 1.0 + v; }, nullptr},
    {"fan_pressure_ratio", "fraction", "pressure rise of the fan's map", build, 0.005,
     [](EngineData& e, double v) { e.fan.scale.s_pr *= 1.0 + v; }, nullptr},
    {"lpc_pressure_ratio", "fraction", "pressure rise of the LPC's map", build, 0.005,
     [](EngineData& e, double v) { e.lpc.scale.s_pr *= 1.0 + v; }, nullptr},
    {"hpc_pressure_ratio", "fraction", "pressure rise of the HPC's map", build, 0.005,
     [](EngineData& e, double v) { e.hpc.scale.s_pr *= 1.0 + v; }, nullptr},
    {"soak_conductance", "fraction", "heat conductance between gas and metal", metal, 0.3,
     [](EngineData& e, double v) {
       for (HeatSoakData& lump : e.metal) lump.conductance_w_k *= 1.0 + v;
     },
     nullptr},
    {"soak_capacity", "fraction", "heat capacity of the metal", metal, 0.3,
     [](EngineData& e, double v) {
       for (HeatSoakData& lump : e.metal) lump.capacity_j_k *= 1.0 + v;
     },
     nullptr},
    {"mach_error", "Mach", "reported minus true Mach number", inputs, 0.003, nullptr,
     [](ReportedInputs& r, double v) { r.flight.mach = std::max(0.0, r.flight.mach + v); }},
    {"altitude_error", "m", "reported minus true pressure altitude", inputs, 15.0, nullptr,
     [](ReportedInputs& r, double v) { r.flight.altitude_m += v; }},
    {"air_temperature_error", "K", "reported minus true deviation from the standard day", inputs, 0.5, nullptr,
     [](ReportedInputs& r, double v) { r.flight.delta_isa_k += v; }},
    {"fuel_meter_error", "fraction", "reported over true fuel flow, minus one", inputs, 0.005, nullptr,
     [](ReportedInputs& r, double v) { r.fuel_flow_kg_s *= 1.0 + v; }},
}};

/// Normal within three sigma.
double cut_normal(NoiseSource& random) {
  for (;;)
    if (const double x = random.normal(); std::abs(x) <= 3.0) return x;
}

}  // namespace

std::span<const MismatchCause, mismatch_count> mismatch_causes() {
  return causes;
}

Mismatch drawn_mismatch(const MismatchDraw& draw, std::uint64_t seed) {
  NoiseSource random(seed);
  Mismatch mismatch{};
  for (std::size_t i = 0; i < mismatch_count; ++i) {
    const double deviate = cut_normal(random);  // drawn always, so that no group changes another's
    if (!draw.has(causes[i].group)) continue;
    mismatch[i] = causes[i].sigma * (causes[i].group == metal ? std::copysign(1.0, deviate) : deviate);
  }
  return mismatch;
}

EngineData built(EngineData data, const Mismatch& mismatch) {
  for (std::size_t i = 0; i < mismatch_count; ++i)
    if (causes[i].alter != nullptr && mismatch[i] != 0.0) causes[i].alter(data, mismatch[i]);
  return data;
}

ReportedInputs misread(ReportedInputs truth, const Mismatch& mismatch) {
  for (std::size_t i = 0; i < mismatch_count; ++i)
    if (causes[i].misread != nullptr && mismatch[i] != 0.0) causes[i].misread(truth, mismatch[i]);
  return truth;
}

}  // namespace ehm::engine_sim
