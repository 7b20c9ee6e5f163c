// SPDX-License-Identifier: Apache-2.0
#pragma once
// The 27 linear models LINxyz of Endurthi's thesis, tables I to V: columns of the states by method x, of the controls by
// y, of health by z (block_columns.h), all with one step; and the tangent (step_study.h), which the thesis lacks.
// Shape of a Jacobian: outputs x inputs of the plant. Errors: those of block_columns.h and step_study.h.

#include <array>
#include <string>
#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "tuner_design/linearise/block_columns.h"

namespace ehm::tuner_design::endurthi {

inline constexpr std::size_t model_count = 27;

/// "000" to "222", x first.
std::string model_digits(std::size_t model);

/// In the order of their digits.
std::array<Eigen::MatrixXd, model_count> jacobians(const Plant& plant, const ColumnSteps& steps);

/// Numbers of models that are one: no column differs by more than `closeness` of its length, rates measured by their
/// states' trims, outputs by theirs. Each model is in one group, that of the first it resembles.
std::vector<std::vector<std::size_t>> coinciding(const Plant& plant,
                                                 const std::array<Eigen::MatrixXd, model_count>& models,
                                                 double closeness);

/// Continuous, without auxiliary outputs, names and noise; deviations from the plant's steady point.
linear_model::LinearModel linear_model_of(const Plant& plant, const Eigen::MatrixXd& jacobian, double sample_time_s);

}  // namespace ehm::tuner_design::endurthi
