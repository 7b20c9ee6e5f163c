// SPDX-License-Identifier: Apache-2.0
#pragma once
// Scores as coloured cells on a logarithmic scale about 1: blue below, orange above, the stronger the further; the
// number stands in the cell, a black corner marks a score that has a defect. Beside the rows, or on a narrow drawing
// below them, bars of a second quantity on a logarithmic axis. A legend stands in the drawing, which so says all by
// itself. Errors: none.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tuner_design/report/page/chart_frame.h"

namespace ehm::tuner_design::report {

struct ScoreMatrix {
  std::string id, title, description;  ///< `id`: letters, digits and hyphens, unique on the page
  std::vector<std::string> rows, columns;
  Eigen::MatrixXd values;  ///< rows x columns; not finite: no score
  Eigen::MatrixXi marked;  ///< rows x columns; not 0: has the defect; empty: none has
  std::string scale_title;
  std::string mark_title{};    ///< what the defect is
  double full_scale = 10.0;    ///< the strongest colours are for this and for 1 over this
  std::vector<double> bars{};  ///< one a row; empty: none
  std::string bar_title{};     ///< with unit
};

/// Empty: the legend stands in the drawing.
std::vector<LegendEntry> legend_of(const ScoreMatrix& matrix);

std::string draw(const ScoreMatrix& matrix, double width, const std::string& id);

}  // namespace ehm::tuner_design::report
