// SPDX-License-Identifier: Apache-2.0
#pragma once
// Capacities of one engine. Channels travel on the wire in arrays of a fixed length, which these are
// (idl/engine_health.idl); the number of states is what a filter has room for.

#include <cstddef>

namespace ehm::linear_model {

inline constexpr int max_sensors = 16;
inline constexpr int max_health = 16;
inline constexpr int max_auxiliary = 8;
inline constexpr int max_actuators = 8;
inline constexpr int max_states = 16;
inline constexpr std::size_t max_name_length = 63, max_unit_length = 31;  ///< characters of a channel's name and unit
inline constexpr std::size_t hash_length = 64;                            ///< characters of a SHA-256

}  // namespace ehm::linear_model
