// SPDX-License-Identifier: Apache-2.0
#pragma once
// The numbers behind a figure or a table: what is drawn, printed, downloaded as CSV and given out as JSON is this.
// Columns carry their unit in the name, as in "sigma_percent". Errors: none.

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

namespace ehm::tuner_design::report {

using Cell = std::variant<std::string, double>;

/// A number that does not exist; shown as "–".
inline constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

struct DataTable {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  ///< each as long as `columns`
};

/// RFC 4180 with line feeds; numbers in shortest exact form, empty where not finite; control characters become spaces.
std::string to_csv(const DataTable& table);

/// {"columns": [...], "rows": [[...], ...]}; null where a number is not finite.
nlohmann::ordered_json to_json(const DataTable& table);

/// "data:text/csv..." for a link.
std::string csv_link(const DataTable& table);

}  // namespace ehm::tuner_design::report
