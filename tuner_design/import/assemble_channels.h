// SPDX-License-Identifier: Apache-2.0
#pragma once
// Names, units, trims and standard deviations of the channels, where a file may leave each of them unstated:
//   name    x1.. u1.. h1.. y1.. z1..
//   trim and unit both missing: the channel counts as given in percent of trim, unit "percent", trim 0, and stays so
//           (engine_sim/linear_model/scaling.h); what the monitor receives and publishes is in percent of trim, too
//   trim missing, unit stated: trim 0, values are deviations from trim in that unit
//   unit missing, trim stated: unit "unknown"
//   health  trim 0; unit percent if a sensor counts as given in percent, else fraction

#include <string>
#include <vector>

#include "tuner_design/import/import_model.h"
#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// Fills the five channel lists of `result` to the sizes of its matrices A, B, L, C, F.
/// @throws files::FileError if a list of names, units or trims has another length.
void assemble_channels(const Variables& given, ImportedModel& result);

/// Values of a vector variable, `size` of them, in a row or a column; one number stands for all if `allow_scalar`. NaN
/// where nothing is stated. `each` says what one value belongs to, for messages ("row of C").
/// @throws files::FileError if the length is another.
Eigen::VectorXd vector_of(const Variables& given, const std::string& name, Eigen::Index size, const std::string& each,
                          bool allow_scalar = false);

/// "y1, y3" for the channels where `chosen` is true, "y1 to y7" for all of many.
std::string listed(const std::vector<linear_model::Channel>& channels, const std::vector<bool>& chosen);

}  // namespace ehm::tuner_design
