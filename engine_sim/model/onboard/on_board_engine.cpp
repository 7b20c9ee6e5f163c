#include "engine_sim/model/onboard/on_board_engine.h"

#include <algorithm>
#include <cmath>

namespace ehm::engine_sim {
namespace {

bool all_finite(const GasPath& gas) {
  const GasPathQuantities<double> y = quantities_of(gas);
  return std::all_of(y.begin(), y.end(), [](double quantity) { return std::isfinite(quantity); });
}

}  // namespace

OnBoardEngine::OnBoardEngine(const Turbofan& engine)
    : engine_(engine), balance_(engine), start_(engine.data().design.unknowns), last_(start_) {}

void OnBoardEngine::start(const FlowUnknowns& near) noexcept {
  start_ = last_ = near;
  tangent_.forget();
}

GasPathStatus OnBoardEngine::close(const Operation& operation, const SpoolSpeeds& speeds,
                                   const MetalTemperatures* metal, FlowUnknowns& x, GasPath& gas) noexcept {
  const auto guess = tangent_.continued(inputs_of(operation, speeds, metal), balance_.intake());
  GasPathStatus status = GasPathStatus::no_solution;
  for (const FlowUnknowns& from : {guess.value_or(last_), start_}) {
    x = from;
    status = balance_.try_solve(operation, speeds, x, gas, metal);
    if (status != GasPathStatus::no_solution) break;
  }
  return status == GasPathStatus::ok && !all_finite(gas) ? GasPathStatus::not_finite : status;
}

GasPathStatus OnBoardEngine::evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas,
                                      const MetalTemperatures* metal) noexcept {
  GasPathStatus status = balance_.prepare(operation, speeds);
  if (status != GasPathStatus::ok) return status;
  GasPath found;
  FlowUnknowns x;
  status = close(operation, speeds, metal, x, found);
  if (status != GasPathStatus::ok) return status;
  tangent_.solved(inputs_of(operation, speeds, metal), balance_.intake(), x);
  last_ = x;
  gas = found;
  return status;
}

GasPathStatus OnBoardEngine::evaluate(const Operation& operation, const SpoolSpeeds& speeds, GasPath& gas,
                                      GasPathJacobian& jacobian, const MetalTemperatures* metal) noexcept {
  GasPath found;
  const GasPathStatus status = evaluate(operation, speeds, found, metal);
  if (status != GasPathStatus::ok) return status;
  const auto slopes = differentiate(engine_, balance_.intake(), operation, speeds, last_, metal, jacobian);
  if (!slopes) return GasPathStatus::no_solution;
  tangent_.turn(*slopes);
  balance_.continue_with(slopes->inverse_jacobian);
  gas = found;
  return status;
}

}  // namespace ehm::engine_sim
