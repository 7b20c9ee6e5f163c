// SPDX-License-Identifier: Apache-2.0
#pragma once
// The motion of the true engine about its balance, and what it adds to sensors and outputs:
//
//   dx[k+1] = A dx[k] + w[k],  cov(w) = Q        y: + C dx        z: + F dx
//
// A, Q n x n, C m x n, F r x n of the discrete model; channel units. It is stationary from the first sample on,
// cov(dx) = A cov(dx) A^T + Q: the engine has run before anybody looked at it. Health is constant meanwhile.
// Errors: see stationary_covariance; none for a model that has passed linear_model::check_model.

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/estimation/capacity.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {

class EngineMotion {
 public:
  /// `discrete` need not outlive this. Without `process_noise` dx stays 0, and no random number is drawn.
  EngineMotion(const linear_model::LinearModel& discrete, bool process_noise);

  bool moves() const { return moves_; }
  /// dx of the first sample.
  estimation::StateVector begin(RandomStream& random) const;
  void advance(estimation::StateVector& dx, RandomStream& random) const;
  void add_to_sensors(estimation::SensorVector& dy, const estimation::StateVector& dx) const;
  void add_to_auxiliary(estimation::AuxiliaryVector& z, const estimation::StateVector& dx) const;

 private:
  using StateMatrix = estimation::BoundedMatrix<estimation::max_states, estimation::max_states>;

  bool moves_;
  StateMatrix A_, root_, start_;  ///< roots of Q and of cov(dx)
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_states> C_;
  estimation::BoundedMatrix<estimation::max_auxiliary, estimation::max_states> F_;
};

}  // namespace ehm::tuner_design
