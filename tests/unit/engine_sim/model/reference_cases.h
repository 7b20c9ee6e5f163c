// SPDX-License-Identifier: Apache-2.0
#pragma once
// The NPSS cases and linear models of the reference data, as the tests read them. Absent data is reported, not guessed.

#include <map>
#include <string>
#include <vector>

namespace ehm::engine_sim::reference {

using Case = std::map<std::string, double>;  ///< column name to value, units of the file (lbm/s, psia, R, lbf, ft)

bool available();
std::string path(const std::string& file);
inline constexpr const char* absent = "reference data is absent: set EHM_REFERENCE_DIR to the folder that holds it";

/// Converged cases with power code at least `lowest_power_code`.
std::vector<Case> npss_cases(double lowest_power_code);

}  // namespace ehm::engine_sim::reference
