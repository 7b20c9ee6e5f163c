// SPDX-License-Identifier: Apache-2.0
#pragma once
// How an engine that flies differs from its file, and what is reported of its surroundings from what is so: the causes,
// by name, each with its spread over a fleet.
//   build    constants that manufacture leaves open: nozzle areas, cooling flows, heating value of the fuel, map scales
//   soak     conductance and capacity of the metal
//   inputs   errors of air data and fuel meter, constant over a flight
// A value is relative to what it alters, but for those whose unit says otherwise; 0 is no mismatch. Spread: build and
// inputs are normal, cut at three sigma; soak is its size in either direction.
// Sizes: what the flight study of this project assumes; none of them is of a real fleet.
// Errors: none.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

enum class MismatchGroup { build, metal, inputs };

/// What instruments say of that which acts on the engine.
struct ReportedInputs {
  FlightCondition flight;
  double fuel_flow_kg_s = 0.0;
};

struct MismatchCause {
  std::string_view name, unit, description;
  MismatchGroup group;
  double sigma;
  void (*alter)(EngineData&, double value);        ///< null for inputs
  void (*misread)(ReportedInputs&, double value);  ///< null for the others
};

inline constexpr std::size_t mismatch_count = 15;
/// By cause, in the order of mismatch_causes(); all zero is an engine as its file says.
using Mismatch = std::array<double, mismatch_count>;

std::span<const MismatchCause, mismatch_count> mismatch_causes();

/// Which groups of causes an engine of a fleet has.
struct MismatchDraw {
  bool build = false, soak = false, inputs = false;
  bool has(MismatchGroup group) const {
    return group == MismatchGroup::build ? build : group == MismatchGroup::metal ? soak : inputs;
  }
};

/// One engine of the fleet: the same seed gives the same engine, and a group is drawn alike with and without others.
Mismatch drawn_mismatch(const MismatchDraw& draw, std::uint64_t seed);

/// The engine as built.
EngineData built(EngineData data, const Mismatch& mismatch);
/// What is reported while `truth` is so.
ReportedInputs misread(ReportedInputs truth, const Mismatch& mismatch);

}  // namespace ehm::engine_sim
