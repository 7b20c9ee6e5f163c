// SPDX-License-Identifier: Apache-2.0
#pragma once
// How the channels that a source describes fit the design's, and its values as the design's: the same unit, another one
// of the same quantity (converted), or a channel that must not be used.
//
//   misfit   why                                                       its values
//   none     the design's name and unit, or a unit that converts       used, converted
//   name     a name that the design does not have                      used, converted; somebody should look
//   place    a name that the design has for another channel            not used: the order is not the design's
//   unit     a unit that is not known, or of another quantity          not used
//
// What is not used is NaN and not valid, so that a sensor is missing, and a sample without an actuator malformed. A
// name or unit that is empty says nothing, and fits.
//
// Real-time safe: yes.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "deploy/runtime/units/units.h"
#include "engine_sim/linear_model/linear_model.h"
#include "monitor/data/sample.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

enum class Misfit : std::uint32_t { none, name, place, unit };

/// A channel as its source describes it.
struct ChannelWords {
  std::string_view name, unit;
};

/// Name and unit as the wire bounds them.
struct DescribedChannel {
  std::array<char, estimation::max_name_length + 1> name{};
  std::array<char, estimation::max_unit_length + 1> unit{};

  ChannelWords words() const noexcept { return {name.data(), unit.data()}; }
};

struct ChannelFit {
  Misfit misfit = Misfit::none;
  units::Conversion conversion;

  bool used() const noexcept { return misfit == Misfit::none || misfit == Misfit::name; }
  bool operator==(const ChannelFit&) const = default;
};

/// Of channel `i` of the design's `channels`.
ChannelFit fit_channel(const ChannelWords& said, const std::vector<linear_model::Channel>& channels,
                       std::size_t i) noexcept;

struct SourceFit {
  std::array<ChannelFit, estimation::max_sensors> sensors;
  std::array<ChannelFit, estimation::max_actuators> actuators;

  /// The sample in the design's units.
  void apply(Sample& sample) const noexcept;
  bool operator==(const SourceFit&) const = default;
};

}  // namespace ehm::monitor
