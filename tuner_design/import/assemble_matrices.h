// SPDX-License-Identifier: Apache-2.0
#pragma once
// The nine matrices of a model, and their dimensions, from named variables.

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/import/import_model.h"
#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// Fills A to N of `result`; D and G that are missing become zero, which is told.
/// @throws files::FileError if A, L, C or M is missing, F without N or N without F, or a shape does not fit the
///         others.
void assemble_matrices(const Variables& given, ImportedModel& result);

}  // namespace ehm::tuner_design
