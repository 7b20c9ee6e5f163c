// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything that the gas path can be asked for and set to, by name: the one home of channel names and units. An engine
// file picks its sensors, auxiliary outputs, controls and health parameters from here; the deck's columns, the wire's
// descriptions and the linear models follow. A new channel is one line.
// Names: SAE AS755 where it has one (W, P, T total, Ps static, and the station of gas_path.h); units: SI.
// Errors: none; a name that is not in the table is found as nullptr. Real-time safe: yes, reading and setting.

#include <span>
#include <string_view>

#include "engine_sim/model/engine_data.h"
#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

/// A quantity of the solved gas path.
struct OutputChannel {
  std::string_view name, unit;
  std::string_view column;  ///< of a performance deck; empty: none, where a steady point has nothing to tell
  std::string_view description;
  double (*read)(const GasPath&, const Ratings&);
};

/// What acts on the gas path from outside and is known: u of a linear model.
struct ControlChannel {
  std::string_view name, unit;
  std::string_view column;  ///< as the input of a performance deck
  std::string_view description;
  double lowest, highest;  ///< what the gas path accepts
  double size;             ///< of a disturbance that a linear model is made with; 0: its own value
  double& (*of)(Operation&);
};

std::span<const OutputChannel> output_channels();
std::span<const ControlChannel> control_channels();

const OutputChannel* find_output(std::string_view name);
const ControlChannel* find_control(std::string_view name);
/// Position in gas_path.h's order, or nothing: health_count.
std::size_t find_health(std::string_view name);

/// "a, b, c", for messages.
std::string output_names();
std::string control_names();
std::string health_parameter_names();

}  // namespace ehm::engine_sim
