#include "engine_sim/model/solve/flow_balance.h"

#include <Eigen/LU>
#include <cmath>

namespace ehm::engine_sim {
namespace {

constexpr NewtonProblem<flow_unknown_count> flow_balance{flow_balance_names, flow_unknown_box::lower,
                                                         flow_unknown_box::upper, flow_unknown_box::largest_step};
// Newton's last step goes far below its tolerance; this one stops as soon as conservation to 1e-9 is safe.
constexpr double closed = 1e-10;
constexpr int most_broyden_steps = 8;
// A guess further off is not one that Broyden's method should continue from, nor a step that improves less.
constexpr double largest_start_residual = 0.05, least_improvement = 0.5;

/// x + dx, if that is inside the box and no component is larger than its largest step.
template <class Step>
bool advance(std::array<double, flow_unknown_count>& x, const Step& dx) {
  for (std::size_t i = 0; i < flow_unknown_count; ++i) {
    const double step = dx(static_cast<Eigen::Index>(i)), moved = x[i] + step;
    if (!(std::abs(step) <= flow_balance.largest_step[i])) return false;
    if (moved < flow_balance.lower[i] || moved > flow_balance.upper[i]) return false;
    x[i] = moved;
  }
  return true;
}

}  // namespace

const Intake& FlowBalance::intake_at(const FlightCondition& flight) {
  if (!flown_ || !(flown_->flight == flight)) flown_ = Flown{flight, intake(engine_.data().inlet, flight)};
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
  double norm = r.lpNorm<Eigen::Infinity>();
  if (!(norm < largest_start_residual)) return false;
  for (int i = 0; i < most_broyden_steps && norm >= closed; ++i) {
    const Vector dx = -h * r;
    if (!advance(x, dx)) return false;
    const Vector r_next = evaluate(held, x);
    const double next = r_next.lpNorm<Eigen::Infinity>();
    if (!(next < least_improvement * norm)) return false;
    const Vector hy = h * (r_next - r);
    const Vector correction = (dx - hy) / dx.dot(hy);
    h += correction * (dx.transpose() * h).eval();
    r = r_next;
    norm = next;
  }
  return norm < closed;
}

void FlowBalance::newton(const Held& held, Unknowns& x) {
  using D = Dual<flow_unknown_count>;
  CycleInput<D> input{held.speeds.n1_rpm, held.speeds.n2_rpm, held.operation.fuel_flow_kg_s, {}};
  std::array<D, flow_unknown_count> r;
  engine_sim::newton(flow_balance, x, [&](const std::array<D, flow_unknown_count>& trial) {
    input.unknowns = unpack(trial);
    ++exact_evaluations_;
    return r = engine_.cycle(flown_->intake, held.operation, input, held.metal).flow_residual;
  });
  Matrix jacobian;
  for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
    jacobian.row(i) = Vector(r[static_cast<std::size_t>(i)].d.data()).transpose();
  }
  inverse_jacobian_ = jacobian.partialPivLu().inverse();
  evaluate(held, x);
}

GasPath FlowBalance::solve(const Operation& operation, const SpoolSpeeds& speeds, FlowUnknowns& unknowns,
                           const MetalTemperatures* metal) {
  require_valid(operation);
  require_valid(speeds);
  intake_at(operation.flight);
  plain_evaluations_ = exact_evaluations_ = 0;
  const Held held{operation, speeds, metal};
  Unknowns x = pack(unknowns);
  if (!inverse_jacobian_ || !broyden(held, x)) {
    inverse_jacobian_.reset();  // what a failed attempt has made of it is not to be trusted
    x = pack(unknowns);
    newton(held, x);
  }
  unknowns = {unpack(x)};
  GasPath gas = engine_.report(input_, cycle_);
  if (metal != nullptr) gas.metal_k = *metal;
  return gas;
}

}  // namespace ehm::engine_sim
