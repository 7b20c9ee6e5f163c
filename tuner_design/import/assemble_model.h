// SPDX-License-Identifier: Apache-2.0
#pragma once
// From named variables to a linear model, for every format that may leave things unstated.
//   sizes   n rows of A, nu columns of B, p columns of L, m rows of C, r rows of F. A, L, C, M must be there; without B
//           (or with an empty one) no controls, without F no auxiliary outputs; D and G that are missing are zero
//   time    Ts above 0: discrete; -1: discrete, 0 or missing: continuous, then sample_time_s or the option tells it
//   noise   sensor_noise_sigma or a diagonal R; Q n x n, its diagonal, or one variance for all
// Names, units and trims: assemble_channels.h.

#include "tuner_design/import/import_model.h"
#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// @throws files::FileError if something necessary is missing, something has the wrong shape or an entry that makes no
///         sense, or an option contradicts what is stated;
///         and as linear_model::check_model does.
ImportedModel assemble_model(const Variables& given, const ImportOptions& options, int sensor_capacity);

}  // namespace ehm::tuner_design
