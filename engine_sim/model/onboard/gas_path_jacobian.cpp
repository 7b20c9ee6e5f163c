// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/onboard/gas_path_jacobian.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"

namespace ehm::engine_sim {
namespace {

using D = GasPathDual;
constexpr int unknown_count = static_cast<int>(flow_unknown_count),
              input_count = static_cast<int>(gas_path_input::count);
using ByUnknowns = Eigen::Matrix<double, 1, unknown_count>;
using ByInputs = Eigen::Matrix<double, 1, input_count>;

auto by_unknowns(const D& x) {
  return ByUnknowns::Map(x.d.data());
}
auto by_inputs(const D& x) {
  return ByInputs::Map(x.d.data() + unknown_count);
}

/// Every element of `at` as an independent variable, the first of them number `first`.
template <std::size_t N>
std::array<D, N> variables(const std::array<double, N>& at, std::size_t first) {
  std::array<D, N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = D::variable(at[i], first + i);
  return out;
}

std::optional<UnknownsSlopes> unknowns_slopes(const std::array<D, flow_unknown_count>& residuals) {
  Eigen::Matrix<double, unknown_count, unknown_count> r_x;
  Eigen::Matrix<double, unknown_count, input_count> r_p;
  for (int i = 0; i < unknown_count; ++i) {
    const D& r = residuals[as_size(i)];
    r_x.row(i) = by_unknowns(r);
    r_p.row(i) = by_inputs(r);
  }
  const auto lu = r_x.partialPivLu();
  const UnknownsSlopes slopes{-lu.solve(r_p), lu.inverse()};
  if (!slopes.by_input.allFinite() || !slopes.inverse_jacobian.allFinite()) return std::nullopt;
  return slopes;
}

}  // namespace

std::optional<UnknownsSlopes> differentiate(const Turbofan& engine, const Intake& intake, const Operation& operation,
                                            const SpoolSpeeds& speeds, const FlowUnknowns& unknowns,
                                            const MetalTemperatures* metal, GasPathJacobian& jacobian) noexcept {
  const auto drive = drive_of(operation, variables(inputs_of(operation, speeds, metal), flow_unknown_count));
  const CycleInput<D> input{drive.speeds.n1_rpm, drive.speeds.n2_rpm, drive.operation.fuel_flow_kg_s,
                            unpack(variables(pack(unknowns), 0))};
  const Cycle<D> cycle = engine.cycle(intake, drive.operation, input, metal ? &drive.metal : nullptr);
  GasPathOf<D> gas;
  if (engine.publish(input, cycle, gas) != FlowDefect::none) return std::nullopt;
  const auto slopes = unknowns_slopes(cycle.flow_residual);
  if (!slopes) return std::nullopt;
  const GasPathQuantities<D> y = quantities_of(gas);
  GasPathJacobian total;
  for (int i = 0; i < total.rows(); ++i) {
    const D& yi = y[as_size(i)];
    total.row(i) = by_inputs(yi);
    for (int k = 0; k < unknown_count; ++k) total.row(i) += by_unknowns(yi)(k) * slopes->by_input.row(k);
  }
  if (!total.allFinite()) return std::nullopt;
  jacobian = total;
  return slopes;
}

}  // namespace ehm::engine_sim
