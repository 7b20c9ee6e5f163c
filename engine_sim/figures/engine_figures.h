// SPDX-License-Identifier: Apache-2.0
#pragma once
// The five pictures of an engine: which part of each map they show, and where a steady point lies on each.
//   compressors: n = N/(sqrt(T/288.15 K) s_nc), T at the component's inlet;  turbines: N/(sqrt(T[R]) s_nc)
// Speed lines: those of the JT9D's tables, so far as the map goes.

#include <optional>
#include <vector>

#include "deploy/runtime/files/csv_table.h"
#include "engine_sim/figures/figure.h"
#include "engine_sim/model/engine_data.h"

namespace ehm::engine_sim {

/// @throws files::FileError for a defect of the reference table, SolveError if an operating line cannot be computed
std::vector<Figure> engine_figures(const EngineData& engine, const std::optional<files::CsvTable>& reference);

}  // namespace ehm::engine_sim
