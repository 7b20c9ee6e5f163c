// SPDX-License-Identifier: Apache-2.0
#pragma once
// The kinds of sensor faults as words: in scenario files, on command lines, in answers.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "idl/wire_values.h"

namespace ehm::idl {

/// Of SensorFaultKind, by value.
inline constexpr std::array sensor_fault_names{"none", "bias", "drift", "stuck", "dropout", "noise"};
static_assert(sensor_fault_names.size() == static_cast<std::size_t>(SensorFaultKind::noise) + 1);

/// Nothing for a word that is none of them.
inline std::optional<SensorFaultKind> sensor_fault_kind(std::string_view name) {
  const auto found = std::find(sensor_fault_names.begin(), sensor_fault_names.end(), name);
  if (found == sensor_fault_names.end()) return {};
  return static_cast<SensorFaultKind>(found - sensor_fault_names.begin());
}

}  // namespace ehm::idl
