// SPDX-License-Identifier: Apache-2.0
#pragma once
// The columns of a performance deck: each input with its range and where it goes, each output and where it comes from.
//   inputs   altitude_m, mach, delta_isa_k; one demand; optionally geometry, off-take and the ten health fractions
//   outputs  what the channel table tells of a steady point, in its order
// Units stand in the names, SI. The ranges are those that the model accepts (a test holds them together); the
// demands, which it leaves open, are kept to numbers of an engine.
// Errors: none.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine_sim/engines/channel_table.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

struct DeckInput {
  std::string name;
  double lowest, highest;
  bool required = false;
  std::optional<DemandKind> demand;                  ///< of the columns with one, a file has exactly one
  std::function<void(Operation&, double)> set = {};  ///< not for a demand
};

const std::vector<DeckInput>& deck_inputs();
/// The channels that have a column.
const std::vector<const OutputChannel*>& deck_outputs();

}  // namespace ehm::engine_sim
