// SPDX-License-Identifier: Apache-2.0
#pragma once
// A schedule by hand: one speed, two readings (the speed, a temperature that rises with speed and with one of two
// health parameters), one output; everything straight in corrected speed and Mach number, so that interpolation is
// exact.

#include "monitor/schedule/point_lookup.h"

namespace ehm::test {

inline schedule::Node node_at(double n1, double mach) {
  schedule::Node n;
  n.valid = true;
  n.x0 = Eigen::VectorXd::Constant(1, n1);
  n.u0 = Eigen::VectorXd::Constant(1, 0.5 + 1e-3 * n1 + 0.1 * mach);
  n.y0 = Eigen::Vector2d(n1, 300.0 + 0.2 * n1 - 20.0 * mach);
  n.z0 = Eigen::VectorXd::Constant(1, 10.0 * n1);
  n.A = Eigen::MatrixXd::Constant(1, 1, -1.0);
  n.B = Eigen::MatrixXd::Constant(1, 1, 1000.0);
  n.L = (Eigen::MatrixXd(1, 2) << 5.0, -3.0).finished();
  n.C = Eigen::Vector2d(1.0, 0.2);
  n.D = Eigen::Vector2d(0.0, 10.0);
  n.M = (Eigen::MatrixXd(2, 2) << 0.0, 0.0, -2.0 - 1e-3 * n1, 1.0 - 2.0 * mach).finished();
  n.F = Eigen::MatrixXd::Constant(1, 1, 10.0);
  n.G = Eigen::MatrixXd::Constant(1, 1, 0.0);
  n.N = (Eigen::MatrixXd(1, 2) << 20.0, 30.0).finished();
  n.lambda_x = Eigen::VectorXd::Constant(1, 0.1);
  n.lambda_y = Eigen::Vector2d(0.01, 0.05);
  n.lambda_z = Eigen::VectorXd::Constant(1, 1.0);
  return n;
}

inline schedule::Schedule small_schedule() {
  schedule::Schedule s;
  s.axes = {{schedule::Variable::n1_corrected, {1000.0, 1500.0, 3000.0}}, {schedule::Variable::mach, {0.0, 0.8}}};
  for (const double mach : s.axes[1].points)
    for (const double n1 : s.axes[0].points) s.nodes.push_back(node_at(n1, mach));
  s.states = {{0.0, 0.5}};
  s.actuators = {{1.0, 0.5}};
  s.sensors = {{0.0, 0.5}, {0.0, 1.0}};
  s.auxiliary = {{1.0, 0.0}};
  s.eta_y = Eigen::Vector2d(0.06, 0.18);
  s.eta_z = Eigen::VectorXd::Constant(1, 10.0);
  return s;
}

}  // namespace ehm::test
