// SPDX-License-Identifier: Apache-2.0
#pragma once
// Derivatives of a closed gas path by the implicit function theorem:
//   r(x, p) = 0:  X_p = -r_x^-1 r_p;   y(x, p):  dy/dp = y_p + y_x X_p
// x: the six flow unknowns, r: the six flow balances (turbofan.h), p: gas_path_inputs.h, y: gas_path_quantities.h.
// All partial derivatives are exact: they come from one evaluation of the cycle in dual numbers.
// Shapes: dy/dp 40 x 19, X_p 6 x 19. The first rows and columns are the states', so A, B and L of a linear model are
// blocks of the top rows, C, D and M those columns of the sensors' rows. Units: quantity per input.
// Errors: a singular r_x, or what is not finite, is told as a value. Real-time safe: yes.
// Source: Griewank & Walther, Evaluating Derivatives, 2nd ed., chapter 15 (implicit functions).

#include <Eigen/Core>
#include <optional>

#include "engine_sim/model/onboard/gas_path_inputs.h"
#include "engine_sim/model/onboard/gas_path_quantities.h"

namespace ehm::engine_sim {

using GasPathJacobian = Eigen::Matrix<double, static_cast<int>(gas_path_quantity::count),
                                      static_cast<int>(gas_path_input::count), Eigen::RowMajor>;

/// How the flow unknowns follow the inputs, and the inverse of r_x.
struct UnknownsSlopes {
  Eigen::Matrix<double, static_cast<int>(flow_unknown_count), static_cast<int>(gas_path_input::count), Eigen::RowMajor>
      by_input;
  Eigen::Matrix<double, static_cast<int>(flow_unknown_count), static_cast<int>(flow_unknown_count)> inverse_jacobian;
};

/// At the solution `unknowns`; `jacobian` is written only if there is an answer.
std::optional<UnknownsSlopes> differentiate(const Turbofan& engine, const Intake& intake, const Operation& operation,
                                            const SpoolSpeeds& speeds, const FlowUnknowns& unknowns,
                                            const MetalTemperatures* metal, GasPathJacobian& jacobian) noexcept;

}  // namespace ehm::engine_sim
