// SPDX-License-Identifier: Apache-2.0
#pragma once
// The pendulum on a cart of pendulum_study.h as a state space. Units: m, rad, s. Errors: none.

#include "monitor/nonlinear/state_space.h"

namespace ehm::tuner_design::endurthi {

inline constexpr double pendulum_step_s = 0.005;

class PendulumSpace final : public nonlinear::StateSpace {
 public:
  /// `upright`: F of the upright pendulum at rest, whatever the state.
  explicit PendulumSpace(bool upright = false) : upright_(upright) {}
  [[nodiscard]] Eigen::Index order() const noexcept override { return 4; }
  [[nodiscard]] Eigen::Index sensor_count() const noexcept override { return 1; }
  bool respond(const nonlinear::OrderVector& x, nonlinear::Response& response) noexcept override;
  bool respond(const nonlinear::OrderVector& x, nonlinear::Response& response,
               nonlinear::Slopes& slopes) noexcept override;

  /// x' and its derivatives by x.
  static Eigen::Vector4d rates(const Eigen::Vector4d& x);
  static Eigen::Matrix4d rate_slopes(const Eigen::Vector4d& x);

 private:
  bool upright_;
};

}  // namespace ehm::tuner_design::endurthi
