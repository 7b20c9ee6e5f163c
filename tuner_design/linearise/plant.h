// SPDX-License-Identifier: Apache-2.0
#pragma once
// A nonlinear plant about a steady point, as a function f of v, open loop:
//   v = [x; u; h]     states n, controls nu, health p
//   f = [dx/dt; y]    dx/dt = 0 at the steady point v0; y all outputs
// What the linearisation methods need of an engine, and all that they know of it. Units: those of v and f, time in s.
// Errors: those of f.

#include <Eigen/Core>
#include <functional>

namespace ehm::tuner_design {

struct Plant {
  Eigen::Index states, controls, health;
  Eigen::VectorXd v0, f0;
  Eigen::VectorXd size;    ///< of each input, for relative steps
  Eigen::VectorXd lowest;  ///< that each input may be
  std::function<Eigen::VectorXd(const Eigen::VectorXd& v)> f;

  Eigen::Index first_control() const { return states; }
  Eigen::Index first_health() const { return states + controls; }
  Eigen::Index inputs() const { return first_health() + health; }
  Eigen::Index outputs() const { return f0.size(); }

  /// v0 with input j moved.
  Eigen::VectorXd moved(Eigen::Index j, double step) const {
    Eigen::VectorXd v = v0;
    v(j) += step;
    return v;
  }
};

}  // namespace ehm::tuner_design
