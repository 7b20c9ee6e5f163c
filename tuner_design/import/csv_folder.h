// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear model as a folder of CSV files.
//   A.csv L.csv C.csv M.csv, B.csv D.csv F.csv G.csv N.csv, Q.csv R.csv, linearisation_error.csv
//                 matrices: numbers only, one row a line, without a header;
//                 an empty file is an empty matrix
//   channels.csv  kind,name,unit,trim,sigma,resolution,update_period_s: one line a channel, in the order of the
//                 matrices' rows and columns;
//                 kind is state, control, health, sensor or auxiliary,
//                 sigma belongs to health and sensors, the last two to sensors;
//                 columns but kind may be left out, cells may be empty: not stated
//   settings.csv  key,value: Ts, sample_time_s, name, engine_type, altitude_m, mach, delta_isa_k
// Both of the latter may be missing. Other files are told as ignored.

#include <string>

#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// @throws files::FileError (file, line, column) if a file cannot be read, a cell is not a finite number, a line has
///         another number of cells, or channels.csv or settings.csv has an unknown column, kind or key.
Variables read_csv_folder(const std::string& folder);

}  // namespace ehm::tuner_design
