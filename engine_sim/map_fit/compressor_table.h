// SPDX-License-Identifier: Apache-2.0
#pragma once
// A compressor map as a table on (speed n, R-line R), prepared for the fit of compressor_map.h:
//   phi = Wc/n^a,  psi = ln((PR - 1)/n^b),  eff        rows: speeds, columns: R-lines
// Weights: 1 where engines operate, less towards surge and choke, 0 where the table is clipped (PR = 1, efficiency =
// 0); double for the flow that a choked line holds, lest the surface overshoot it. The table is extended by rows and
// columns of smaller weight, so that the smooth map continues as physics does:
//   below the lowest speed:  phi, psi, eff of the lowest line (similarity: Wc ~ n^a, PR - 1 ~ n^b, eff constant)
//   above the highest speed: the mean growth exponents and efficiency slope of the two highest lines
//   beyond the last R-line:  choked flow stays; ln(PR - 1) and the work go on straight, the efficiency is what both
//                            give, so that a choking compressor absorbs less and less
// Units: Wc lbm/s at 518.67 R and 14.696 psia, otherwise ratios. Source: similarity laws; the margins are choices.

#include <Eigen/Core>
#include <vector>

namespace ehm::engine_sim {

struct CompressorTable {
  std::vector<double> speed, r_line;
  Eigen::MatrixXd flow, pressure_ratio, efficiency;
};

struct CompressorTarget {
  std::vector<double> speed, r_line;
  Eigen::MatrixXd phi, psi, efficiency;
  Eigen::MatrixXd flow_weight, pressure_weight, efficiency_weight;
};

/// A speed line where the table bends, and the speed to which the bend is moved.
struct Corner {
  double at, moved_to;
};

/// The table with its corner moved: the slopes of the last interval below the corner continue to `moved_to`, from there
/// on every R-line runs straight to the highest speed, in steps of 0.0025. The lines in between are dropped.
/// Why: a bilinear table jumps in slope at the corner, and an engine that runs just below it has the slope of the side
/// on which it lies; a C2 surface through the corner has half of each. @throws std::invalid_argument if `at` is no
/// speed line of the table between its second and its last
CompressorTable move_corner(const CompressorTable& table, const Corner& corner);

/// Weight of one sample of the table itself.
double sample_weight(double r_line, double pressure_ratio, double efficiency);

CompressorTarget fit_target(const CompressorTable& table, double flow_exponent, double pressure_exponent);

}  // namespace ehm::engine_sim
