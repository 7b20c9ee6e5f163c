// SPDX-License-Identifier: Apache-2.0
#pragma once
// Endurthi's inverted pendulum on a cart: extended against unscented Kalman filter where the model is far from linear.
//   (M + m) y'' + m l cos(th) th'' - m l sin(th) th'^2 + F y' = u,   (J + m l^2) th'' + m l cos(th) y'' = m g l sin(th)
// M 1 kg, m 0.2 kg, l 1 m, J = m r^2/2 with r 0.02 m, th(0) = 0.1 rad, u = 0: it falls through pi near 1.3 s. The cart's
// position y is measured every 5 ms for 3 s. State [y th y' th'], steps by Runge & Kutta's fourth-order method, F by its
// variational equation. Not given in the thesis and chosen here: F 0.1 N s/m, noise of y 1 cm, of the rates 1e-3 a step,
// the start known to 0.05.
//   ekf, upright    F of the upright pendulum all the way: the thesis' Jacobian
//   ekf             F at the estimate
//   ukf             symmetric set; beta 2, and 0: the thesis has "2, set to 1 - a^2"
// The figure is the root mean square error of th and y over the runs, before and after 1.5 s.
// Errors: none. The same seed gives the same numbers.

#include <cstdint>
#include <string>
#include <vector>

namespace ehm::tuner_design::endurthi {

struct PendulumOptions {
  std::size_t runs = 100;
  std::uint64_t seed = 1;
};

struct PendulumFilter {
  std::string name;
  double angle_before_rad = 0, angle_after_rad = 0, position_before_m = 0, position_after_m = 0;
};

inline constexpr double pendulum_split_s = 1.5;

std::vector<PendulumFilter> run_pendulum_study(const PendulumOptions& options);

}  // namespace ehm::tuner_design::endurthi
