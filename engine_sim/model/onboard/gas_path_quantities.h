// SPDX-License-Identifier: Apache-2.0
#pragma once
// What a gas path can be asked, as a vector with named places: first the rates of the states, in the order of
// gas_path_inputs.h, then the quantities with the names that a deck gives them.
// Units: those in the names, stall margins in percent. Without heat soak the metal's rates are zero. Errors: none.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/gas_path.h"

namespace ehm::engine_sim {

namespace gas_path_quantity {
// clang-format off
inline constexpr std::array<std::string_view, 40> names{
    "n1_dot_rpm_s", "n2_dot_rpm_s", "metal_hpc_dot_k_s", "metal_hpt_dot_k_s", "metal_lpt_dot_k_s",
    "w_2_kg_s",  "pt_2_pa",  "tt_2_k",   "w_13_kg_s", "pt_13_pa", "tt_13_k",
    "w_21_kg_s", "pt_21_pa", "tt_21_k",  "w_24_kg_s", "pt_24_pa", "tt_24_k",
    "w_30_kg_s", "pt_30_pa", "tt_30_k",  "w_40_kg_s", "pt_40_pa", "tt_40_k",
    "w_48_kg_s", "pt_48_pa", "tt_48_k",  "w_50_kg_s", "pt_50_pa", "tt_50_k",
    "ps_30_pa", "n1_rpm", "n2_rpm", "fuel_flow_kg_s", "net_thrust_n", "gross_thrust_n",
    "bypass_ratio", "overall_pressure_ratio", "stall_margin_fan", "stall_margin_lpc", "stall_margin_hpc"};
// clang-format on
inline constexpr std::size_t count = names.size();

/// Place of a quantity, none if no quantity has this name.
constexpr std::optional<std::size_t> place(std::string_view name) {
  const auto at = std::find(names.begin(), names.end(), name);
  if (at == names.end()) return std::nullopt;
  return as_size(at - names.begin());
}
}  // namespace gas_path_quantity

template <class S>
using GasPathQuantities = std::array<S, gas_path_quantity::count>;

template <class S>
GasPathQuantities<S> quantities_of(const GasPathOf<S>& g) {
  const auto& [hpc_dot, hpt_dot, lpt_dot] = g.metal_dot_k_s;
  // clang-format off
  return {g.n1_dot_rpm_s, g.n2_dot_rpm_s, hpc_dot, hpt_dot, lpt_dot,
          g.s2.w_kg_s,  g.s2.pt_pa,  g.s2.tt_k,   g.s13.w_kg_s, g.s13.pt_pa, g.s13.tt_k,
          g.s21.w_kg_s, g.s21.pt_pa, g.s21.tt_k,  g.s24.w_kg_s, g.s24.pt_pa, g.s24.tt_k,
          g.s30.w_kg_s, g.s30.pt_pa, g.s30.tt_k,  g.s40.w_kg_s, g.s40.pt_pa, g.s40.tt_k,
          g.s48.w_kg_s, g.s48.pt_pa, g.s48.tt_k,  g.s50.w_kg_s, g.s50.pt_pa, g.s50.tt_k,
          g.ps_30_pa, g.speeds.n1_rpm, g.speeds.n2_rpm, g.fuel_flow_kg_s, g.net_thrust_n, g.gross_thrust_n,
          g.bypass_ratio, g.overall_pressure_ratio,
          g.stall_margin_fan_percent, g.stall_margin_lpc_percent, g.stall_margin_hpc_percent};
  // clang-format on
}

}  // namespace ehm::engine_sim
