// SPDX-License-Identifier: Apache-2.0
#pragma once
// What every nonlinear filter of a state space does, one sample after another:
//
//   start(x, P)  ->  for each sample   foresee(model, sigma) -> update(model, nu, fused) -> advance(model)
//
// foresee() asks what the sensors should read at the estimate that the last step led to, and how uncertain that is;
// update() takes in the innovations of the sensors that are fused; advance() goes one step on, with what acts on the
// model then. The innovation is handed in by the caller, who may know of more between the engine and a reading than
// the model does (a lag): a filter that asks the model again within a sample counts from there.
// Units: those of the model. sigma: standard deviation of each sensor's noise.
// Errors: false where the model had no answer; the estimate is then what it was, and the filter can be asked again.
// Real-time safe: yes, all of it. The same calls give the same bits.

#include <memory>

#include "monitor/nonlinear/state_space.h"

namespace ehm::nonlinear {

/// The least and the greatest value of each state; infinite where it is free.
struct StateBox {
  OrderVector least, greatest;
};

/// What a filter needs to know beside the model.
struct FilterNoise {
  OrderVector process_variance;  ///< diagonal of Q, a step
};

class NonlinearFilter {
 public:
  virtual ~NonlinearFilter() = default;
  [[nodiscard]] virtual std::unique_ptr<NonlinearFilter> clone() const = 0;

  virtual void start(const OrderVector& x, const OrderMatrix& covariance) noexcept = 0;
  /// Adds to the uncertainty: what nobody knows any more.
  virtual void open(const OrderVector& variance) noexcept = 0;
  virtual bool foresee(StateSpace& model, const SensorVector& sigma) noexcept = 0;
  virtual bool update(StateSpace& model, const SensorVector& innovation, SensorMask fused) noexcept = 0;
  virtual bool advance(StateSpace& model) noexcept = 0;

  /// Of the readings, at the last foresee().
  [[nodiscard]] const SensorVector& predicted() const noexcept { return predicted_; }
  /// diag(H P H' + R), or what stands for it.
  [[nodiscard]] const SensorVector& innovation_variance() const noexcept { return innovation_variance_; }
  /// Of the last step: after advance() the predicted one.
  [[nodiscard]] const OrderVector& estimate() const noexcept { return x_; }
  [[nodiscard]] const OrderMatrix& covariance() const noexcept { return p_; }

 protected:
  NonlinearFilter() = default;
  NonlinearFilter(const NonlinearFilter&) = default;
  NonlinearFilter& operator=(const NonlinearFilter&) = default;

  OrderVector x_;
  OrderMatrix p_;
  SensorVector predicted_, innovation_variance_;
};

}  // namespace ehm::nonlinear
