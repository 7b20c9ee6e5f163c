// SPDX-License-Identifier: Apache-2.0
#pragma once
// A linear model as a MATLAB v5 file, which save writes with -v6, or compressed with -v7; Octave and scipy write it,
// too. Its variables are those of variables.h, at the top level or as fields of one structure. Read by libmatio.

#include <string>

#include "tuner_design/import/variables.h"

namespace ehm::tuner_design {

/// True if the name ends in .mat or the file begins as MATLAB's do.
bool is_mat_file(const std::string& path);

/// @throws files::FileError if the file is of another version, damaged, has a variable twice or several structures that
///         could be meant, or a variable that is not what it has to be (mat_value.h).
Variables read_mat_file(const std::string& path);

}  // namespace ehm::tuner_design
