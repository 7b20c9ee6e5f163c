// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables I to V of Endurthi's thesis as published: its engine is MAPSS, a military engine of low bypass ratio, ours is
// not: the numbers are context, no target. The tables are of the first point, idle at sea level; of the second there are
// figures only.

#include <array>

#include "tuner_design/endurthi/linear_models.h"

namespace ehm::tuner_design::endurthi {

/// Table I; table II has LIN022 in all cells, and LIN122 as well where the models of 0.01 % meet a test of 0.5 %.
inline constexpr const char* published_best_average = "LIN212";
inline constexpr const char* published_best_final = "LIN022";
inline constexpr const char* published_best_final_first_row_last_column = "LIN122, LIN022";

/// Health parameters 1 to 10 without number 4, then their average; percent.
using PublishedHealth = std::array<double, 10>;

struct PublishedModel {
  double average_1e4, final_1e4;               ///< table III
  PublishedHealth unconstrained, constrained;  ///< tables IV and V
};

/// In the order of their digits.
extern const std::array<PublishedModel, model_count> published_models;

}  // namespace ehm::tuner_design::endurthi
