// SPDX-License-Identifier: Apache-2.0
#pragma once
// Which of the 27 linear models is best where, ours and published: what tables I to III of Endurthi's thesis ask.
// Errors: none.

#include <string>

#include "tuner_design/endurthi/linearisation_study.h"

namespace ehm::tuner_design::endurthi {

/// LIN212 and LIN022: best in the thesis' tables I and II.
inline constexpr std::size_t published_average_model = 23, published_final_model = 8;

/// What a table judges by.
using ErrorPart = double ModelError::*;

/// "LIN000" to "LIN222", or "tangent".
std::string model_name(std::size_t model);

/// Of the 27.
std::size_t best_of(const ModelErrors& errors, ErrorPart part);

/// How many times the best of its cell a model misses, in its worst cell.
double worst_ratio(const LinearisationPoint& point, std::size_t model, ErrorPart part);

/// Of all models the one that needs to know least of the change that comes.
std::size_t safest_of(const LinearisationPoint& point, ErrorPart part);

/// As printed in table 1 or 2, by the places of both perturbations in studied_percents.
std::string published_best(int table, std::size_t linearised, std::size_t test);

}  // namespace ehm::tuner_design::endurthi
