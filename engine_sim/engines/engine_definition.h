// SPDX-License-Identifier: Apache-2.0
#pragma once
// What an engine is, as one value: the gas path's data, the data of its control, and its named channels. The file of it
// is engine_file.h, the shipped ones are shipped_engines.h.
// Errors: none. Units: those of the parts and of channel_table.h.

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "engine_sim/engines/channel_table.h"
#include "engine_sim/engines/control_data.h"
#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

/// What the percent of a sensor's noise refer to: the value at trim, which is a fixed size, or the present reading.
enum class NoiseOf { trim, reading };
inline constexpr std::array<std::string_view, 2> noise_of_names{"trim", "reading"};

struct SensorChannel {
  const OutputChannel* quantity;
  double noise_percent;     ///< standard deviation
  double lag_s = 0.0;       ///< first order; 0: none
  double resolution = 0.0;  ///< smallest step of a reading, in the quantity's unit; 0: none
  NoiseOf noise_of = NoiseOf::trim;
};

struct HealthChannel {
  Health parameter;
  double sigma;  ///< standard deviation over the fleet, fraction
};

/// In the order of the wire and of a linear model's matrices.
struct NamedChannels {
  std::vector<SensorChannel> sensors;
  std::vector<const OutputChannel*> auxiliary;  ///< what no sensor measures and an estimator is asked for
  std::vector<const ControlChannel*> controls;
  std::vector<HealthChannel> health;
};

struct EngineDefinition {
  std::string source;  ///< where the numbers come from; may be empty
  EngineData data;
  ControlData control;
  NamedChannels channels;
};

/// The name as other files refer to it: small letters, without blanks: "JT9D" is jt9d, "high-bypass turbofan"
/// high-bypass-turbofan.
std::string engine_type(const EngineData& data);

}  // namespace ehm::engine_sim
