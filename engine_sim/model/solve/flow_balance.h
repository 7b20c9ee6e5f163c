// SPDX-License-Identifier: Apache-2.0
#pragma once
// The flow balance of the gas path solved again and again along a flight. At given spool speeds and operation:
//   r(x) = 0,  x: the six unknowns of flow_unknowns.h,  r: the six flow balances of turbofan.h
// Broyden's method continues from the last solution's inverse Jacobian H (6 x 6), one plain evaluation a step:
//   dx = -H r,  y = r(x + dx) - r,  H <- H + (dx - H y) dx' H / (dx' H y)
// Where it does not converge at once - and at first - Newton's method with exact derivatives (newton.h) starts again
// from the guess and leaves a fresh H. The same sequence of calls gives the same numbers. Units: none (x, r).
// Source: Dennis & Schnabel, Numerical Methods for Unconstrained Optimization and Nonlinear Equations, chapter 8.

#include <Eigen/Core>
#include <optional>

#include "engine_sim/model/turbofan.h"

namespace ehm::engine_sim {

class FlowBalance {
 public:
  /// `engine` must live as long as this.
  explicit FlowBalance(const Turbofan& engine) : engine_(engine) {}
  /// Continues where `near` stands, with this engine or a slightly different one, and closes to `tolerance`.
  FlowBalance(const Turbofan& engine, const FlowBalance& near, double tolerance = closed)
      : engine_(engine), tolerance_(tolerance), inverse_jacobian_(near.inverse_jacobian_) {
    if (&engine_ == &near.engine_) flown_ = near.flown_;
  }
  /// Newton's last step goes far below its tolerance; Broyden's stops as soon as conservation to 1e-9 is safe.
  static constexpr double closed = 1e-10;

  using Matrix = Eigen::Matrix<double, flow_unknown_count, flow_unknown_count>;

  /// Checks the ranges and looks up intake(). Real-time safe: yes; allocates and throws nothing.
  GasPathStatus prepare(const Operation& operation, const SpoolSpeeds& speeds) noexcept;

  /// Closes the balances from the guess `unknowns`, which it updates; `metal`: temperatures for the heat soak, or none.
  /// Unless the status is ok, `gas` keeps what it held. Gives up after 30 exact evaluations.
  /// Real-time safe: yes; allocates and throws nothing.
  GasPathStatus try_solve(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns, GasPath& gas,
                          const MetalTemperatures* metal = nullptr) noexcept;

  /// The same, but it searches on to the end. Real-time safe: yes, unless it throws.
  /// @throws as Turbofan::gas_path
  GasPath solve(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                const MetalTemperatures* metal = nullptr);

  /// The next solution continues from this inverse of dr/dx.
  void continue_with(const Matrix& inverse_jacobian) noexcept { inverse_jacobian_ = inverse_jacobian; }
  /// Of the last flight condition that was prepared or solved.
  const Intake& intake() const { return flown_->intake; }
  /// Evaluations of the cycle by the last solve().
  int plain_evaluations() const { return plain_evaluations_; }
  int exact_evaluations() const { return exact_evaluations_; }

 private:
  using Vector = Eigen::Matrix<double, flow_unknown_count, 1>;
  using Unknowns = std::array<double, flow_unknown_count>;
  using Problem = NewtonProblem<flow_unknown_count>;
  /// All that is held while the unknowns are sought.
  struct Held {
    const Operation& operation;
    const SpoolSpeeds& speeds;
    const MetalTemperatures* metal;
  };

  const Intake& intake_at(const FlightCondition& flight);
  Vector evaluate(const Held& held, const Unknowns& x);
  bool broyden(const Held& held, Unknowns& x);
  NewtonEnd newton(const Problem& problem, const Held& held, Unknowns& x);
  /// Input and flight condition have been checked.
  NewtonEnd close(const Problem& problem, const Held& held, FlowUnknowns& unknowns);

  struct Flown {
    FlightCondition flight;
    Intake intake;
  };

  const Turbofan& engine_;
  double tolerance_ = closed;               ///< of the largest residual
  std::optional<Flown> flown_;              ///< the last flight condition and what the engine sees of it
  std::optional<Matrix> inverse_jacobian_;  ///< none before the first solution
  CycleInput<double> input_{};
  Cycle<double> cycle_{};  ///< the last evaluation; at the solution when solve() reports it
  int plain_evaluations_ = 0, exact_evaluations_ = 0;
};

}  // namespace ehm::engine_sim
