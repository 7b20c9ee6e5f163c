// SPDX-License-Identifier: Apache-2.0
#pragma once
// Response time against accuracy. Larger Qh answers faster and scatters more; at each Qh the tuners are searched anew.
//   slowest time constant  tau(Qh, V) = -T_sample / ln(spectral radius of Acl), falls as Qh rises
//   SSEE = bias + noise, of h and z: G Ph G^T and T S T^T of kalman_error.h, with the linearisation error apart

#include <functional>
#include <string>
#include <vector>

#include "monitor/design/design.h"

namespace ehm::tuner_design {

/// One point of the trade: the tuners are those of the search at this Qh, unless stated.
struct ResponsePoint {
  double qh_percent2 = 0.0;
  double time_constant_s = 0.0;
  double health_bias = 0.0, health_noise = 0.0;                      ///< percent^2; they add up to SSEE(h)
  double auxiliary_bias = 0.0, auxiliary_noise = 0.0;                ///< reporting units^2; they add up to SSEE(z)
  double health_linearisation = 0.0, auxiliary_linearisation = 0.0;  ///< what a nonlinear engine adds
  double closed_form_health = 0.0, closed_form_auxiliary = 0.0;      ///< SSEE of V = H Ph at the same Qh
  double objective = 0.0;                                            ///< J of the searched tuners

  [[nodiscard]] double health() const noexcept { return health_bias + health_noise; }
  [[nodiscard]] double auxiliary() const noexcept { return auxiliary_bias + auxiliary_noise; }
};

/// Qh at which the slowest time constant of the filter on its own best tuners is `time_constant_s`, to 1e-6 relative;
/// for an envelope that of the slowest point.
/// @throws std::invalid_argument if no Qh from 1e-12 to 100 gives it; the message tells what is in reach.
/// @throws as design_tuner.
double qh_for_time_constant(const std::vector<linear_model::LinearModel>& models, const std::vector<double>& weights,
                            const design::DesignOptions& options, double time_constant_s);

/// As many tuners as the design has, on all its sensors, with its weights; qh ascending. `progress` is told how many
/// points are done.
std::vector<ResponsePoint> response_sweep(
    const design::Design& design, const std::vector<double>& qh_percent2, unsigned threads = 1,
    const std::function<void(std::size_t)>& progress = [](std::size_t) {});

/// The points as CSV, units in the column names.
std::string response_csv(const std::vector<ResponsePoint>& points);

/// `count` values from first to last, evenly spaced in the logarithm.
std::vector<double> logarithmic_steps(double first, double last, int count);

}  // namespace ehm::tuner_design
