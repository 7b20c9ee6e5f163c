// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/full_order/gauss_markov.h"

#include <cmath>
#include <stdexcept>

#include "monitor/design/gauss_markov_design.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/prepared_point.h"

namespace ehm::tuner_design {

double gauss_markov_rho(const linear_model::LinearModel& model, double qh_percent2) {
  const double variance = model.health_sigma.squaredNorm() / static_cast<double>(model.health_sigma.size());
  if (!(qh_percent2 > 0.0 && qh_percent2 < variance)) {
    throw std::invalid_argument("Gauss-Markov filter: qh is " + std::to_string(qh_percent2) +
                                " percent^2 per sample; allowed: above 0 and below the fleet's variance, " +
                                std::to_string(variance));
  }
  return std::sqrt(1.0 - qh_percent2 / variance);
}

design::SubsetDesign gauss_markov_design(const linear_model::LinearModel& model, const estimation::SteadyGain& steady,
                                         double rho) {
  design::SubsetDesign design = design::gauss_markov_filter(model, all_sensors(model), rho);
  const double seen_s = design.slowest_time_constant_s;
  add_error_theory(design, model, steady);
  design.slowest_time_constant_s = seen_s;
  return design;
}

estimation::GaussMarkovGain gauss_markov_gain(const design::SubsetDesign& design, double rho) {
  return {rho, design.K, design.innovation_variance};
}

}  // namespace ehm::tuner_design
