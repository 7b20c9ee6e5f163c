// SPDX-License-Identifier: Apache-2.0
#pragma once
// Values of a MATLAB variable as numbers and texts.

#include <matio.h>

#include <Eigen/Core>
#include <string>
#include <vector>

namespace ehm::tuner_design {

/// Any real numeric class, full or sparse, or logical, as double; complex only if its imaginary part is zero.
/// `place` is file and variable, for messages.
/// @throws files::FileError if it is no such thing, has more than two dimensions, is larger than any model, or has an
///         entry that is not finite (says which, counted from 1 as MATLAB does).
Eigen::MatrixXd mat_numbers(const matvar_t& variable, const std::string& place);

/// A text, a character matrix (a text a row, blanks at the end removed), or a cell array of texts; plain ASCII.
/// @throws files::FileError if it is no such thing.
std::vector<std::string> mat_texts(const matvar_t& variable, const std::string& place);

}  // namespace ehm::tuner_design
