// SPDX-License-Identifier: Apache-2.0
#pragma once
// A matrix as coloured cells with a signed scale: blue for positive, orange for negative, the stronger the larger; the
// number stands in the cell where there is room. Row and column names are those of the users' channels. Errors: none.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tuner_design/report/page/chart_frame.h"
#include "tuner_design/report/page/data_table.h"

namespace ehm::tuner_design::report {

struct HeatMap {
  std::string id, title, description;  ///< `id`: letters, digits and hyphens, unique on the page
  std::vector<std::string> rows, columns;
  Eigen::MatrixXd values;   ///< rows x columns
  std::string scale_title;  ///< what a cell is, with unit
  double full_scale = 0.0;  ///< the strongest colour; 0: the largest entry
};

std::vector<LegendEntry> legend_of(const HeatMap& map);

std::string draw(const HeatMap& map, double width, const std::string& id);

/// A row for each row, its name in column `corner`.
DataTable data_of(const HeatMap& map, const std::string& corner);

}  // namespace ehm::tuner_design::report
