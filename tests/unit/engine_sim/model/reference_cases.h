// SPDX-License-Identifier: Apache-2.0
#pragma once
// The NPSS cases and linear models that the tests compare with: some in the repository (tests/unit/engine_sim/fixtures),
// all of them in the reference data. Absent data is reported, not guessed.
// @throws std::runtime_error if a file of the repository cannot be read or lacks a cell

#include <map>
#include <string>
#include <vector>

namespace ehm::engine_sim::reference {

using Case = std::map<std::string, double>;  ///< column name to value, units of the file (lbm/s, psia, R, lbf, ft)

bool available();
std::string path(const std::string& file);
inline constexpr const char* absent = "reference data is absent: set EHM_REFERENCE_DIR to the folder that holds it";

/// A file of the repository's.
std::string fixture(const std::string& file);

/// Converged cases of the reference data with power code at least `lowest_power_code`.
std::vector<Case> npss_cases(double lowest_power_code);

/// The same of the two dozen in the repository.
std::vector<Case> npss_points(double lowest_power_code);

}  // namespace ehm::engine_sim::reference
