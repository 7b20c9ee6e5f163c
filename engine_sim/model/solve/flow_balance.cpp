// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/flow_balance.h"

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {
namespace {

constexpr NewtonProblem<flow_unknown_count> flow_balance{flow_balance_names, flow_unknown_box::lower,
                                                         flow_unknown_box::upper, flow_unknown_box::largest_step};
/// For try_solve(): what succeeds from a start anywhere needs 8 evaluations in the mean, 99.8 % need 20 or fewer.
constexpr NewtonProblem<flow_unknown_count> flow_balance_in_time = [] {
  auto problem = flow_balance;
  problem.max_evaluations = 30;
  return problem;
}();
constexpr int most_broyden_steps = 8;
// A guess further off is not one that Broyden's method should continue from, nor a step that improves less.
constexpr double largest_start_residual = 0.05, least_improvement = 0.5;

/// Not a number if one of them is none.
template <class Vector>
double largest(const Vector& r) {
  return r.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace

const Intake& FlowBalance::intake_at(const FlightCondition& flight) {
  if (!flown_ || !(flown_->flight == flight)) {
    flown_ = Flown{flight, engine_sim::intake(engine_.data().inlet, flight)};
  }
  return flown_->intake;
}

FlowBalance::Vector FlowBalance::evaluate(const Held& held, const Unknowns& x) {
  input_ = {held.speeds.n1_rpm, held.speeds.n2_rpm, held.operation.fuel_flow_kg_s, unpack(x)};
  cycle_ = engine_.cycle(flown_->intake, held.operation, input_, held.metal);
  ++plain_evaluations_;
  return Vector(cycle_.flow_residual.data());
}

bool FlowBalance::broyden(const Held& held, Unknowns& x) {
  Matrix& h = *inverse_jacobian_;
  Vector r = evaluate(held, x);
  double norm = largest(r);
  if (!(norm < largest_start_residual)) return false;
  for (int i = 0; i < most_broyden_steps && norm >= tolerance_; ++i) {
    const Vector dx = -h * r;
    if (!advance(x, dx)) return false;
    const Vector r_next = evaluate(held, x);
    const double next = largest(r_next);
    if (!(next < least_improvement * norm)) return false;
    const Vector hy = h * (r_next - r);
    const Vector correction = (dx - hy) / dx.dot(hy);
    h += correction * (dx.transpose() * h).eval();
    r = r_next;
    norm = next;
  }
  return norm < tolerance_;
}

NewtonEnd FlowBalance::newton(const Problem& problem, const Held& held, Unknowns& x) {
  using D = Dual<flow_unknown_count>;
  CycleInput<D> input{held.speeds.n1_rpm, held.speeds.n2_rpm, held.operation.fuel_flow_kg_s, {}};
  std::array<D, flow_unknown_count> r;
  const auto residuals = [&](const std::array<D, flow_unknown_count>& trial) {
    input.unknowns = unpack(trial);
    ++exact_evaluations_;
    return r = engine_.cycle(flown_->intake, held.operation, input, held.metal).flow_residual;
  };
  const NewtonEnd end = try_newton(problem, x, residuals);
  if (!end.closed) return end;
  Matrix jacobian;
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    jacobian.row(i) = Vector(r[as_size(i)].d.data()).transpose();
  }
  inverse_jacobian_ = jacobian.partialPivLu().inverse();
  evaluate(held, x);
  return end;
}

NewtonEnd FlowBalance::close(const Problem& problem, const Held& held, FlowUnknowns& unknowns) {
  plain_evaluations_ = exact_evaluations_ = 0;
  NewtonEnd end{true, {}};
  Unknowns x = pack(unknowns);
  if (!inverse_jacobian_ || !broyden(held, x)) {
    inverse_jacobian_.reset();  // what a failed attempt has made of it is not to be trusted
    x = pack(unknowns);
    end = newton(problem, held, x);
    if (!end.closed) return end;
  }
  unknowns = {unpack(x)};
  return end;
}

GasPathStatus FlowBalance::prepare(const Operation& operation, const SpoolSpeeds& speeds) noexcept {
  const FlightCondition& flight = operation.flight;
  if (!covers(flight)) {
    const bool finite =
        std::isfinite(flight.altitude_m) && std::isfinite(flight.mach) && std::isfinite(flight.delta_isa_k);
    return finite ? GasPathStatus::outside_flight : GasPathStatus::not_finite;
  }
  if (const auto defect = first_defect(operation)) return defect->kind;
  if (const auto defect = first_defect(speeds)) return defect->kind;
  intake_at(flight);
  return GasPathStatus::ok;
}

GasPathStatus FlowBalance::try_solve(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                                     GasPath& gas, const MetalTemperatures* metal) noexcept {
  if (const GasPathStatus status = prepare(operation, speeds); status != GasPathStatus::ok) return status;
  GasPath found;
  if (!close(flow_balance_in_time, {operation, speeds, metal}, unknowns).closed ||
      engine_.publish(input_, cycle_, found) != FlowDefect::none) {
    return GasPathStatus::no_solution;
  }
  if (metal != nullptr) found.metal_k = *metal;
  gas = found;
  return GasPathStatus::ok;
}

GasPath FlowBalance::solve(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                           const MetalTemperatures* metal) {
  require_valid(operation);
  require_valid(speeds);
  intake_at(operation.flight);
  if (const NewtonEnd end = close(flow_balance, {operation, speeds, metal}, unknowns); !end.closed) {
    throw_not_closed(flow_balance, end);
  }
  GasPath gas = engine_.report(input_, cycle_);
  if (metal != nullptr) gas.metal_k = *metal;
  return gas;
}

}  // namespace ehm::engine_sim
