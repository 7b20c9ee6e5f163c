// SPDX-License-Identifier: Apache-2.0
#pragma once
// The seam between a nonlinear filter and the model that it flies:
//   x[k+1] = f(x[k], u) + w,   w ~ (0, Q)        y[k] = g(x[k], u) + v,   v ~ (0, R),  R diagonal
// Shapes: x n, y m; F = df/dx n x n, H = dg/dx m x n. What acts on the model (u) is set on it from outside, before it is
// asked: a filter knows states and readings only. One question answers both f and g, since the gas path of an engine
// gives both. Units: the model's own; a filter scales readings by their noise.
// Errors: what has no answer is false, and then nothing is written. Real-time safe: yes.

#include "monitor/estimation/capacity.h"

namespace ehm::nonlinear {

/// Two spools, and the health parameters; more than any of our models needs.
inline constexpr int max_order = 2 + estimation::max_health;

using OrderVector = estimation::BoundedVector<max_order>;
using OrderMatrix = estimation::BoundedMatrix<max_order, max_order>;
using ReadingSlopes = estimation::BoundedMatrix<estimation::max_sensors, max_order>;
using ReadingMatrix = estimation::BoundedMatrix<estimation::max_sensors, estimation::max_sensors>;
using estimation::SensorMask;
using estimation::SensorVector;

/// f(x) and g(x).
struct Response {
  OrderVector next;
  SensorVector readings;
};

struct Slopes {
  OrderMatrix f;    ///< F
  ReadingSlopes g;  ///< H
};

class StateSpace {
 public:
  virtual ~StateSpace() = default;
  [[nodiscard]] virtual Eigen::Index order() const noexcept = 0;
  [[nodiscard]] virtual Eigen::Index sensor_count() const noexcept = 0;
  virtual bool respond(const OrderVector& x, Response& response) noexcept = 0;
  /// The same, with the derivatives there.
  virtual bool respond(const OrderVector& x, Response& response, Slopes& slopes) noexcept = 0;

 protected:
  StateSpace() = default;
  StateSpace(const StateSpace&) = default;
  StateSpace& operator=(const StateSpace&) = default;
};

}  // namespace ehm::nonlinear
