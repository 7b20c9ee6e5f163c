// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/study_sections/kosanam_set_up.h"

#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {

std::string kosanam_set_up(const std::string& model, const BatchOptions& batch, double health_variance,
                           const std::vector<std::string>& not_known) {
  std::string text =
      "On “" + model + "”: " + std::to_string(batch.runs) + " engines of " + std::to_string(batch.flights) +
      " flights, " + std::to_string(batch.samples) + " samples each, linear truth. Health wears " +
      (batch.equal_wear_percent > 0.0 ? "by " + number(batch.equal_wear_percent) + " % each"
                                      : std::string("to the end of the wear table")) +
      "; qh is " + quantity(health_variance, "percent²") +
      " a sample. The thesis flies DIGTEM, 16 states and 12 sensors: the published numbers are context, no "
      "target.";
  if (!not_known.empty()) text += " Not in the wear table, and so worn as fan_efficiency: " + listed(not_known) + ".";
  return text;
}

}  // namespace ehm::tuner_design::report
