// SPDX-License-Identifier: Apache-2.0
#pragma once
// From linear models to finished designs: one design for all sensors, and one without each single sensor. Which tuners:
// choose_tuners.h; how many: tuner_number.h. Several models are the points of an envelope: their full sensor sets share
// one V*. A sensor that sees nothing of health stays in the model and on the wire, but no design uses it.
// A design without a sensor, and every design of a model that knows its linearisation error, may have fewer tuners than
// sensors: an estimate should not be worse than none, so that of all numbers of tuners that keep every published sigma
// within the fleet's own, the one with the least objective is taken. Where that would cost more than a quarter of the
// objective, a model with a linearisation error keeps the best of all, and its sigma says so. Which combinations of
// health are dropped first follows what stands out least from what a long average still gets wrong
// (closed_form_tuners).

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "monitor/design/design.h"
#include "tuner_design/design/choose_tuners.h"

namespace ehm::tuner_design {

/// Called by the calling thread with the share of the work that is done, 0 to 1.
using DesignProgress = std::function<void(double)>;

/// Names of the health parameters whose total sigma exceeds the fleet's own.
std::vector<std::string> worse_than_prior(const design::SubsetDesign& design, const linear_model::LinearModel& model,
                                          const linear_model::Scaling& scaling);

/// `model` has passed linear_model::check_model. The result does not depend on the number of threads.
/// @throws std::invalid_argument if qh_percent2 is not above zero, or the weights are wrong (point_problem.h).
/// @throws std::runtime_error if no sensor sees anything of health, or a solver fails; says which matrix and why.
design::Design design_tuner(
    const linear_model::LinearModel& model, const design::DesignOptions& options, unsigned threads = 1,
    const DesignProgress& progress = [](double) {});

/// V* of the full sensor set as design_envelope chooses it, but for the random starts.
Eigen::MatrixXd full_set_tuners(const Envelope& envelope, const design::DesignOptions& options);

/// The filter that design_tuner makes of these sensors (ascending) alone in closed form; nullopt if there is none, or
/// none within the fleet's own sigma.
/// @throws std::invalid_argument as design_tuner.
std::optional<design::SubsetDesign> closed_form_filter(const PreparedPoint& point, const std::vector<int>& sensors,
                                                       double qh_percent2, const design::ErrorWeights& weights);

/// The design on given tuners V, with a certificate of the Kalman filter's error at equal weights. No search, and no
/// designs for a missing sensor: for studies, not for flight.
design::Design design_on_tuners(const linear_model::LinearModel& model, const Eigen::MatrixXd& V, double qh_percent2);

/// One V* for all models, one design for each. `weights`: one for each model, above zero.
/// @throws as design_tuner, and std::invalid_argument if the models' health parameters, sensors, auxiliary outputs or
///         units differ (says which model and what).
std::vector<design::Design> design_envelope(
    const std::vector<linear_model::LinearModel>& models, const std::vector<double>& weights,
    const design::DesignOptions& options, unsigned threads = 1, const DesignProgress& progress = [](double) {});

}  // namespace ehm::tuner_design
