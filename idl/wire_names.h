// SPDX-License-Identifier: Apache-2.0
#pragma once
// The documented values of wire_values.h as words, for displays, metrics and logs.

#include <array>
#include <string_view>
#include <utility>

#include "idl/wire_values.h"

namespace ehm::idl {

/// "?" for a value that this version does not know.
inline const char* level_name(std::uint32_t level) {
  constexpr std::array names{"OK", "WARN", "ERROR", "STALE", "STOPPED"};
  return level < names.size() ? names[level] : "?";
}

/// Of EventKind, by value; [0] is none.
inline constexpr std::array event_kind_names{"?",
                                             "sensor_fault",
                                             "health_shift",
                                             "health_limit",
                                             "auxiliary_limit",
                                             "input_lost",
                                             "filter_restart",
                                             "operating_point",
                                             "no_design",
                                             "sample_time",
                                             "second_source",
                                             "ambiguous_fault",
                                             "slow_bias",
                                             "checkpoint",
                                             "configuration",
                                             "input_deadline",
                                             "input_liveliness",
                                             "incompatible_qos",
                                             "recording",
                                             "security",
                                             "source_channels",
                                             "unreadable_peer",
                                             "source_stamps",
                                             "source_sequence",
                                             "condition_fault",
                                             "slow_sensor",
                                             "held_up",
                                             "implausible",
                                             "unlikely_engine",
                                             "engine_left",
                                             "second_monitor",
                                             "command_flood",
                                             "flight_history",
                                             "estimator_fallback",
                                             "estimator_overrun",
                                             "estimator_chosen"};
static_assert(event_kind_names.size() == static_cast<std::size_t>(EventKind::estimator_chosen) + 1);

/// Of EstimatorNumber, by value.
inline constexpr std::array estimator_names{
    "tuner", "gauss_markov", "time_varying", "onboard", "scheduled",   "ekf", "iekf", "clipped_ekf",
    "ukf",   "particle",     "ekpf",         "cekpf",   "constrained", "map", "wls",  "rls"};
static_assert(estimator_names.size() == static_cast<std::size_t>(EstimatorNumber::rls) + 1);

/// The number of a name; -1: of none.
constexpr int estimator_number(std::string_view name) noexcept {
  for (std::size_t i = 0; i < estimator_names.size(); ++i)
    if (name == estimator_names[i]) return static_cast<int>(i);
  return -1;
}

inline constexpr std::array flight_phase_names{"unknown", "taxi", "take_off", "climb", "cruise", "descent", "approach"};
static_assert(flight_phase_names.size() == static_cast<std::size_t>(FlightPhase::approach) + 1);

inline constexpr std::array<std::pair<std::uint32_t, const char*>, 7> estimate_flag_names{
    {{estimate_flag::converging, "converging"},
     {estimate_flag::bridging, "bridging"},
     {estimate_flag::degraded, "degraded"},
     {estimate_flag::off_design, "off_design"},
     {estimate_flag::shifted, "shifted"},
     {estimate_flag::implausible, "implausible"},
     {estimate_flag::fallback, "fallback"}}};

/// Whose estimates a MonitorCommand of that kind has published; empty: no such order.
constexpr std::string_view ordered_estimator(std::uint32_t kind) noexcept {
  const std::uint32_t first = static_cast<std::uint32_t>(MonitorCommandKind::publish);
  return kind >= first && kind - first < estimator_names.size() ? estimator_names[kind - first] : std::string_view();
}

}  // namespace ehm::idl
