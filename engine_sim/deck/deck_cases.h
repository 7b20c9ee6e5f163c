// SPDX-License-Identifier: Apache-2.0
#pragma once
// The cases of a performance deck: each row of the file as what the engine is asked for.

#include <cstddef>
#include <string>
#include <vector>

#include "deploy/runtime/files/csv_table.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {

struct DeckCase {
  std::size_t line;
  std::string inputs;  ///< the cells as the user wrote them, comma separated
  Operation operation;
  Demand demand;
};

struct DeckCases {
  std::string file;
  std::vector<std::string> columns;
  std::vector<DeckCase> cases;
};

/// @throws files::FileError for an unknown or missing column, none or two demands, a cell that is no number in range
DeckCases read_deck_cases(const files::CsvTable& table);

}  // namespace ehm::engine_sim
