#pragma once
// A compressor map as a table on (speed n, R-line R), prepared for the fit of compressor_map.h:
//   phi = Wc/n^a,  psi = ln((PR - 1)/n^b),  eff        rows: speeds, columns: R-lines
// Weights: 1 where engines operate, less towards surge and choke, 0 where the table is clipped (PR = 1, efficiency =
// 0). The table is extended by rows and columns of smaller weight, so that the smooth map continues as physics does:
//   below the lowest speed:  phi, psi, eff of the lowest line (similarity: Wc ~ n^a, PR - 1 ~ n^b, eff constant)
//   above the highest speed: the mean growth exponents and efficiency slope of the two highest lines
//   beyond the last R-line:  choked flow stays, PR and efficiency are left to the smoothing
// Units: Wc lbm/s at 518.67 R and 14.696 psia, otherwise ratios. Source: similarity laws; the margins are choices.

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <vector>

namespace ehm::engine {

struct CompressorTable {
  std::vector<double> speed, r_line;
  Eigen::MatrixXd flow, pressure_ratio, efficiency;
};

struct CompressorTarget {
  std::vector<double> speed, r_line;
  Eigen::MatrixXd phi, psi, efficiency;
  Eigen::MatrixXd flow_weight, pressure_weight, efficiency_weight;
};

/// @throws nlohmann::json::exception if the map lacks NcVec, RlineVec, WcArray, PRArray or EffArray
CompressorTable read_compressor_table(const nlohmann::json& map);

/// Weight of one sample of the table itself.
double sample_weight(double r_line, double pressure_ratio, double efficiency);

CompressorTarget fit_target(const CompressorTable& table, double flow_exponent, double pressure_exponent);

/// Rows of a JSON array of arrays.
Eigen::MatrixXd read_rows(const nlohmann::json& rows);

}  // namespace ehm::engine
