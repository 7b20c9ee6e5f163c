// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/best_models.h"

#include <algorithm>

#include "tuner_design/endurthi/published.h"

namespace ehm::tuner_design::endurthi {

std::string model_name(std::size_t model) {
  return model == tangent_model ? "tangent" : "LIN" + model_digits(model);
}

std::size_t best_of(const ModelErrors& errors, ErrorPart part) {
  const auto best = std::min_element(errors.begin(), errors.begin() + model_count,
                                     [&](const auto& a, const auto& b) { return a.*part < b.*part; });
  return static_cast<std::size_t>(best - errors.begin());
}

double worst_ratio(const LinearisationPoint& point, std::size_t model, ErrorPart part) {
  double worst = 0.0;
  for (const auto& row : point.errors)
    for (const ModelErrors& errors : row)
      worst = std::max(worst, errors[model].*part / (errors[best_of(errors, part)].*part));
  return worst;
}

std::size_t safest_of(const LinearisationPoint& point, ErrorPart part) {
  std::size_t safest = 0;
  for (std::size_t model = 1; model <= model_count; ++model)
    if (worst_ratio(point, model, part) < worst_ratio(point, safest, part)) safest = model;
  return safest;
}

std::string published_best(int table, std::size_t linearised, std::size_t test) {
  if (table == 1) return published_best_average;
  const bool tie = linearised == 0 && test + 1 == studied_percents.size();
  return tie ? published_best_final_first_row_last_column : published_best_final;
}

}  // namespace ehm::tuner_design::endurthi
