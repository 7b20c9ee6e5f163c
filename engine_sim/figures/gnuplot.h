// SPDX-License-Identifier: Apache-2.0
#pragma once
// gnuplot as a program: the script goes in, the picture comes out.
// Errors: @throws std::runtime_error if gnuplot is not installed or refuses the script (with its first message).

#include <string>

namespace ehm::engine_sim {

/// Runs `script`, whose terminal writes to the standard output, into the open file `descriptor`.
void run_gnuplot(const std::string& script, int descriptor);

}  // namespace ehm::engine_sim
