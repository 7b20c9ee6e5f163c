// SPDX-License-Identifier: Apache-2.0
#pragma once
// Flies random demand sequences (demand_sequence.h) and keeps the worst of each: stall margins and what passes a limit.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine_sim/control/controlled_engine.h"

namespace ehm::test {

enum Figure : std::size_t { lpc_margin, hpc_margin, n1_over, n2_over, t48_over, ps_30_over, idle_under, figure_count };
inline constexpr std::array<std::string_view, figure_count> figure_names{
    "LPC stall margin, %",   "HPC stall margin, %",    "N1 over its limit, %", "N2 over its limit, %",
    "T48 over its limit, %", "Ps30 over its limit, %", "N2 below idle, %"};

/// The worst of one figure: what, where, in which sequence and when.
struct Worst {
  double value = 0.0;
  std::uint64_t seed = 0;
  double time_s = 0.0;
  engine_sim::FlightCondition flight{};
  double n1_corrected_rpm = 0.0;
  engine_sim::FuelLoop active = engine_sim::FuelLoop::n1_governor;
  bool worse_than(const Worst& other, Figure figure) const;
};

struct StudyResult {
  std::array<Worst, figure_count> worst;
  std::array<double, engine_sim::fuel_loop_count> seconds_in_loop{};
  std::vector<std::string> failures;  ///< sequences that did not end, with the reason
};

/// Sequences of `duration_s` with seeds first to first + count - 1, on two threads; the result does not depend on them.
StudyResult fly_sequences(std::uint64_t first, std::uint64_t count, double duration_s,
                          engine_sim::HeatSoak heat_soak = engine_sim::HeatSoak::without);

/// The worst cases as a table.
std::string table(const StudyResult& result);

}  // namespace ehm::test
