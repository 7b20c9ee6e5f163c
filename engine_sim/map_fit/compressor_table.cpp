// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/compressor_table.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double extension_weight = 0.2;

double at(const std::vector<double>& v, Index i) {
  return v[as_size(i)];
}

/// phi, psi, efficiency and weights of the samples of the table itself.
CompressorTarget bare_target(const CompressorTable& t, double flow_exponent, double pressure_exponent) {
  CompressorTarget out{t.speed, t.r_line, t.flow, t.flow, t.efficiency, t.flow, t.flow, t.flow};
  for (Index i = 0; i < t.flow.rows(); ++i) {
    for (Index j = 0; j < t.flow.cols(); ++j) {
      const double n = at(t.speed, i), pr = t.pressure_ratio(i, j);
      const double weight = sample_weight(at(t.r_line, j), pr, t.efficiency(i, j));
      out.phi(i, j) = t.flow(i, j) / std::pow(n, flow_exponent);
      out.psi(i, j) = weight > 0.0 ? std::log((pr - 1.0) / std::pow(n, pressure_exponent)) : 0.0;
      // relative errors of Wc and PR count; a choked line keeps its flow to the end, clipped or not
      const bool choked = t.flow(i, j) >= (1.0 - 1e-4) * t.flow(i, t.flow.cols() - 1);
      out.flow_weight(i, j) = (choked ? 2.0 : 1.0) * std::max(weight, 0.3) / out.phi(i, j);
      out.pressure_weight(i, j) = weight * (pr - 1.0) / pr;
      out.efficiency_weight(i, j) = weight;
    }
  }
  return out;
}

/// Mean over the fully weighted R-lines of the last two rows of (last - one before)/(x_last - x_before).
double edge_slope(const MatrixXd& z, const MatrixXd& weight, double x_last, double x_before) {
  double sum = 0.0;
  int count = 0;
  const Index last = z.rows() - 1;
  for (Index j = 0; j < z.cols(); ++j) {
    if (weight(last, j) < 1.0 || weight(last - 1, j) < 1.0) continue;
    sum += (z(last, j) - z(last - 1, j)) / (x_last - x_before);
    ++count;
  }
  return sum / count;
}

void append_row(MatrixXd& z, const Eigen::RowVectorXd& row, bool on_top) {
  MatrixXd grown(z.rows() + 1, z.cols());
  if (on_top) {
    grown << row, z;
  } else {
    grown << z, row;
  }
  z = grown;
}

/// One more speed line: copies the edge line, shifted by constants, at the weight of an extension.
void append_speed(CompressorTarget& t, double speed, bool below, double phi_factor, double psi_shift,
                  double eff_shift) {
  const Index edge = below ? 0 : t.phi.rows() - 1;
  const Eigen::RowVectorXd eff = t.efficiency.row(edge).array() + eff_shift;
  append_row(t.phi, t.phi.row(edge) * phi_factor, below);
  append_row(t.psi, t.psi.row(edge).array() + psi_shift, below);
  append_row(t.efficiency, eff, below);
  append_row(t.flow_weight, t.flow_weight.row(edge) * extension_weight, below);
  append_row(t.pressure_weight, t.pressure_weight.row(edge).cwiseMin(extension_weight), below);
  append_row(t.efficiency_weight, t.efficiency_weight.row(edge).cwiseMin(extension_weight), below);
  t.speed.insert(below ? t.speed.begin() : t.speed.end(), speed);
}

/// One more R-line: choked flow stays; pressure and efficiency get no weight.
void append_choked_line(CompressorTarget& t, double r_line) {
  const auto append = [](MatrixXd& z, const Eigen::VectorXd& column) {
    MatrixXd grown(z.rows(), z.cols() + 1);
    grown << z, column;
    z = grown;
  };
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(t.phi.rows());
  append(t.phi, t.phi.rightCols<1>());
  append(t.flow_weight, t.flow_weight.rightCols<1>());
  append(t.psi, none);
  append(t.pressure_weight, none);
  append(t.efficiency, none);
  append(t.efficiency_weight, none);
  t.r_line.push_back(r_line);
}

/// Ideal work over cp T1 of a pressure ratio, for air at low temperature.
double ideal_work(double pressure_ratio) {
  return std::pow(pressure_ratio, 2.0 / 7.0) - 1.0;
}

/// Beyond the last sample with a pressure rise, speed line by speed line: ln(PR - 1) goes on straight and so does the
/// work, down to a tenth; the efficiency is what both give. So a choking compressor absorbs less and less.
void continue_into_choke(CompressorTarget& t, double pressure_exponent) {
  for (Index i = 0; i < t.phi.rows(); ++i) {
    const double psi_of_speed = pressure_exponent * std::log(at(t.speed, i));
    const auto work = [&](Index j) {
      return ideal_work(1.0 + std::exp(t.psi(i, j) + psi_of_speed)) / t.efficiency(i, j);
    };
    Index last = t.psi.cols() - 1;
    while (t.efficiency_weight(i, last) == 0.0) --last;
    const double step = at(t.r_line, last) - at(t.r_line, last - 1);
    const double psi_slope = std::min(0.0, (t.psi(i, last) - t.psi(i, last - 1)) / step);
    const double work_slope = std::min(0.0, (work(last) - work(last - 1)) / step);
    for (Index j = last + 1; j < t.psi.cols(); ++j) {
      const double beyond = at(t.r_line, j) - at(t.r_line, last);
      t.psi(i, j) = t.psi(i, last) + psi_slope * beyond;
      const double work_j = std::max(work(last) + work_slope * beyond, 0.1 * work(last));
      t.efficiency(i, j) = ideal_work(1.0 + std::exp(t.psi(i, j) + psi_of_speed)) / work_j;
      t.pressure_weight(i, j) = extension_weight * t.pressure_weight(i, last);
      t.efficiency_weight(i, j) = extension_weight;
    }
  }
}

}  // namespace

CompressorTable move_corner(const CompressorTable& table, const Corner& corner) {
  constexpr double step = 0.0025;
  const auto found = std::find(table.speed.begin(), table.speed.end(), corner.at);
  const auto kept = std::distance(table.speed.begin(), found) + 1;
  if (kept < 2 || kept >= std::ssize(table.speed)) {
    throw std::invalid_argument("map fit: the corner n = " + std::to_string(corner.at) +
                                " is not an inner speed line of the table");
  }
  const double below = at(table.speed, kept - 2), highest = table.speed.back();
  const auto added = as_index(std::lround((highest - corner.moved_to) / step)) + 1;

  CompressorTable out = table;
  out.speed.resize(as_size(kept));
  const Eigen::VectorXd share = Eigen::VectorXd::LinSpaced(added, 0.0, 1.0);
  for (const double s : share) out.speed.push_back(corner.moved_to + s * (highest - corner.moved_to));
  const auto moved = [&](const MatrixXd& z) {
    const Eigen::RowVectorXd slope = (z.row(kept - 1) - z.row(kept - 2)) / (corner.at - below);
    const Eigen::RowVectorXd bend = z.row(kept - 1) + slope * (corner.moved_to - corner.at);
    MatrixXd rows(kept + added, z.cols());
    rows << z.topRows(kept), bend.replicate(added, 1) + share * (z.bottomRows<1>() - bend);
    return rows;
  };
  out.flow = moved(table.flow);
  out.pressure_ratio = moved(table.pressure_ratio);
  out.efficiency = moved(table.efficiency);
  return out;
}

double sample_weight(double r_line, double pressure_ratio, double efficiency) {
  if (pressure_ratio <= 1.001 || efficiency < 0.05) return 0.0;
  if (efficiency < 0.5) return 0.1;
  return r_line < 1.3 || r_line > 2.7 ? 0.4 : 1.0;
}

CompressorTarget fit_target(const CompressorTable& table, double flow_exponent, double pressure_exponent) {
  CompressorTarget t = bare_target(table, flow_exponent, pressure_exponent);
  const double lowest = table.speed.front(), highest = table.speed.back();
  const double before = table.speed[table.speed.size() - 2];
  const MatrixXd& weight = t.efficiency_weight;
  const double phi_growth = edge_slope(t.phi.array().log(), weight, std::log(highest), std::log(before));
  const double psi_growth = edge_slope(t.psi, weight, std::log(highest), std::log(before));
  const double eff_slope = edge_slope(t.efficiency, weight, highest, before);

  append_choked_line(t, table.r_line.back() + 0.4);
  append_choked_line(t, table.r_line.back() + 0.8);
  continue_into_choke(t, pressure_exponent);
  append_speed(t, 0.5 * lowest, true, 1.0, 0.0, 0.0);
  append_speed(t, 0.1 * lowest, true, 1.0, 0.0, 0.0);
  for (const double ratio : {1.08, 1.08}) {
    const double speed = t.speed.back() * ratio, log_ratio = std::log(ratio);
    append_speed(t, speed, false, std::exp(phi_growth * log_ratio), psi_growth * log_ratio,
                 eff_slope * (speed - t.speed.back()));
  }
  return t;
}

}  // namespace ehm::engine_sim
