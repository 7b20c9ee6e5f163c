// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/map_fit/turbine_fit.h"

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/map_fit/break_range.h"
#include "engine_sim/map_fit/deviation.h"
#include "engine_sim/map_fit/fit_surface.h"

namespace ehm::engine_sim {

TurbineFit fit_turbine(const TurbineSettings& s, const TurbineTable& table) {
  const std::vector<double>&n = table.speed, &p = table.pressure_ratio;
  check_breaks(s.place, "speed_breaks", s.speed_breaks, n.front(), n.back());
  check_breaks(s.place, "pressure_ratio_breaks", s.pressure_ratio_breaks, p.front(), p.back());
  // g = Wp / sqrt(1 - exp(-k (PR - 1)))
  Eigen::MatrixXd g = table.flow;
  for (Eigen::Index j = 0; j < g.cols(); ++j) {
    const double pressure_ratio = p[as_size(j)];
    g.col(j) = g.col(j).array() / std::sqrt(1.0 - std::exp(-s.choking_rate * (pressure_ratio - 1.0)));
  }
  const Eigen::MatrixXd ones = Eigen::MatrixXd::Ones(g.rows(), g.cols());
  const double size = g.mean();
  return {fit_surface(n, p, g, ones / size, s.speed_breaks, s.pressure_ratio_breaks, map_smoothing / (size * size)),
          fit_surface(n, p, table.efficiency, ones, s.speed_breaks, s.pressure_ratio_breaks, map_smoothing)};
}

engine_sim::TurbineMapData map_data(const TurbineSettings& s, const TurbineFit& fit) {
  return {s.choking_rate, s.speed_breaks, s.pressure_ratio_breaks, fit.flow, fit.efficiency};
}

std::string deviation_text(const TurbineSettings& s, const TurbineFit& fit, const TurbineTable& table) {
  const engine_sim::TurbineMap fitted(map_data(s, fit));
  Deviation flow, efficiency;
  for (Eigen::Index i = 0; i < table.flow.rows(); ++i) {
    for (Eigen::Index j = 0; j < table.flow.cols(); ++j) {
      const auto at = fitted.at(table.speed[as_size(i)], table.pressure_ratio[as_size(j)]);
      flow.add(100.0 * (at.flow / table.flow(i, j) - 1.0));
      efficiency.add(100.0 * (at.efficiency - table.efficiency(i, j)));
    }
  }
  return s.name + ": flow " + flow.text() + " %, efficiency " + efficiency.text() + " points";
}

}  // namespace ehm::engine_sim
