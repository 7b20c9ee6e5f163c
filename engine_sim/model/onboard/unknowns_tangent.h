// SPDX-License-Identifier: Apache-2.0
#pragma once
// Where the flow unknowns go when the inputs change, by the tangent at the last derivatives: a guess whose error is of
// second order spares evaluations of the cycle.
//   x = x0 + X_p (p - p0),  p: speeds and fuel flow at the corrected values that the engine sees (N/sqrt(Tt2),
//   Wf/(Pt2 sqrt(Tt2))), referred to the last intake, so that a change of flight condition changes little else
// Shapes: x of 6, p of 19 (gas_path_inputs.h). A guess beyond the largest step or the box of flow_unknowns.h is none.
// Source: predictor of a continuation method (Allgower & Georg, chapter 2). Errors: none. Real-time safe: yes.

#include <cmath>
#include <optional>

#include "engine_sim/model/onboard/gas_path_jacobian.h"

namespace ehm::engine_sim {

class UnknownsTangent {
 public:
  void solved(const GasPathInputs<double>& inputs, const Intake& intake, const FlowUnknowns& unknowns) {
    last_ = {inputs, intake, unknowns};
  }
  void turn(const UnknownsSlopes& slopes) { by_input_ = slopes.by_input; }
  void forget() {
    last_.reset();
    by_input_.reset();
  }

  std::optional<FlowUnknowns> continued(const GasPathInputs<double>& inputs, const Intake& intake) const {
    if (!last_ || !by_input_) return std::nullopt;
    using namespace gas_path_input;
    using Vector = Eigen::Matrix<double, static_cast<int>(gas_path_input::count), 1>;
    const double root_theta = std::sqrt(last_->intake.tt_k / intake.tt_k);
    const double delta = last_->intake.fan_face_pt_pa / intake.fan_face_pt_pa;
    Vector p(inputs.data());
    p(n1) *= root_theta;
    p(n2) *= root_theta;
    p(fuel_flow) *= delta * root_theta;
    auto x = pack(last_->unknowns);
    if (!advance(x, (*by_input_ * (p - Vector(last_->inputs.data()))).eval())) return std::nullopt;
    return FlowUnknowns{unpack(x)};
  }

 private:
  struct Solved {
    GasPathInputs<double> inputs;
    Intake intake;
    FlowUnknowns unknowns;
  };
  std::optional<Solved> last_;
  std::optional<decltype(UnknownsSlopes::by_input)> by_input_;
};

}  // namespace ehm::engine_sim
