// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/design/response_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/long_work/parallel_for.h"
#include "tuner_design/design/choose_tuners.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/theory/kalman_error.h"
#include "tuner_design/theory/kalman_gain.h"

namespace ehm::tuner_design {
namespace {

constexpr double least_qh = 1e-12, largest_qh = 100.0;

design::SubsetDesign filter_on(const PreparedPoint& point, const Eigen::MatrixXd& V, double qh_percent2) {
  design::SubsetDesign filter = kalman_gain(point.model, all_sensors(point.model), V, qh_percent2);
  add_error_theory(filter, point.model, point.steady);
  return filter;
}

double slowest_time_constant(const Envelope& envelope, const Eigen::MatrixXd& V, double qh_percent2) {
  double slowest = 0.0;
  for (const PreparedPoint& point : envelope.points)
    slowest = std::max(slowest, filter_on(point, V, qh_percent2).slowest_time_constant_s);
  return slowest;
}

/// On fixed tuners, by bisection of log Qh.
double qh_on(const Envelope& envelope, const Eigen::MatrixXd& V, double wanted_s) {
  double low = std::log(least_qh), high = std::log(largest_qh);
  const double slowest = slowest_time_constant(envelope, V, least_qh);
  const double fastest = slowest_time_constant(envelope, V, largest_qh);
  if (!(wanted_s < slowest && wanted_s > fastest)) {
    std::ostringstream message;
    message << "the slowest time constant cannot be " << wanted_s << " s; in reach are " << fastest << " to " << slowest
            << " s, between which Qh goes from " << largest_qh << " to " << least_qh
            << " percent^2 (the engine's own slow modes, such as heat soak, stay)";
    throw std::invalid_argument(message.str());
  }
  while (high - low > 1e-10) {
    const double middle = 0.5 * (low + high);
    (slowest_time_constant(envelope, V, std::exp(middle)) > wanted_s ? low : high) = middle;
  }
  return std::exp(0.5 * (low + high));
}

}  // namespace

double qh_for_time_constant(const std::vector<linear_model::LinearModel>& models, const std::vector<double>& weights,
                            const design::DesignOptions& options, double time_constant_s) {
  constexpr int max_rounds = 50;
  constexpr double close_enough = 1e-8;
  Envelope envelope{{}, weights};
  for (const linear_model::LinearModel& model : models) envelope.points.push_back(prepare(model));
  design::DesignOptions trial = options;
  double previous = 0.0;
  for (int round = 0; round < max_rounds; ++round) {
    // The tuners at this Qh, as the design itself will choose them, then the Qh that they need.
    trial.qh_percent2 = qh_on(envelope, full_set_tuners(envelope, trial), time_constant_s);
    if (std::abs(trial.qh_percent2 / previous - 1.0) <= close_enough) return trial.qh_percent2;
    previous = trial.qh_percent2;
  }
  throw std::runtime_error("time constant: Qh and V* do not settle together");
}

std::vector<ResponsePoint> response_sweep(const design::Design& design, const std::vector<double>& qh_percent2,
                                          unsigned threads, const std::function<void(std::size_t)>& progress) {
  const PreparedPoint point = prepare(design.model);
  const std::vector<int> all = all_sensors(point.model);
  const Eigen::Index t = design.full.V.rows();
  std::vector<ResponsePoint> points(qh_percent2.size());
  const auto work = [&](std::size_t i) {
    design::DesignOptions options = design.options;
    options.qh_percent2 = qh_percent2[i];
    const ChosenTuners searched = choose_tuners({{point}, {1.0}}, all, t, options, 0, 1);
    options.tuning = design::Tuning::closed_form;
    const ChosenTuners closed = choose_tuners({{point}, {1.0}}, all, t, options, 0, 1);
    const design::SubsetDesign filter = filter_on(point, searched.search.V, qh_percent2[i]);
    const design::SubsetDesign on_closed_form = filter_on(point, closed.search.V, qh_percent2[i]);
    ResponsePoint& result = points[i];
    result.qh_percent2 = qh_percent2[i];
    result.time_constant_s = filter.slowest_time_constant_s;
    result.health_noise = filter.health_noise_covariance.trace();
    result.health_linearisation = filter.health_linearisation_covariance.trace();
    result.health_bias = filter.health_total_covariance.trace() - result.health_noise - result.health_linearisation;
    result.auxiliary_noise = filter.auxiliary_noise_covariance.trace();
    result.auxiliary_linearisation = filter.auxiliary_linearisation_covariance.trace();
    result.auxiliary_bias =
        filter.auxiliary_total_covariance.trace() - result.auxiliary_noise - result.auxiliary_linearisation;
    result.closed_form_health =
        (on_closed_form.health_total_covariance.trace() - on_closed_form.health_linearisation_covariance.trace());
    result.closed_form_auxiliary =
        (on_closed_form.auxiliary_total_covariance.trace() - on_closed_form.auxiliary_linearisation_covariance.trace());
    result.objective = objective(searched.problem, searched.search.V);
  };
  long_work::parallel_for(points.size(), threads, work, progress);
  return points;
}

std::string response_csv(const std::vector<ResponsePoint>& points) {
  std::string text =
      "qh_percent2,time_constant_s,health_bias_percent2,health_noise_percent2,ssee_health_percent2,auxiliary_bias,"
      "auxiliary_noise,ssee_auxiliary,linearisation_error_health,linearisation_error_auxiliary,"
      "closed_form_ssee_health_percent2,closed_form_ssee_auxiliary,objective\n";
  for (const ResponsePoint& p : points)
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", p.qh_percent2, p.time_constant_s, p.health_bias,
                        p.health_noise, p.health(), p.auxiliary_bias, p.auxiliary_noise, p.auxiliary(),
                        p.health_linearisation, p.auxiliary_linearisation, p.closed_form_health,
                        p.closed_form_auxiliary, p.objective);
  return text;
}

std::vector<double> logarithmic_steps(double first, double last, int count) {
  std::vector<double> steps;
  for (int i = 0; i < count; ++i)
    steps.push_back(count == 1 ? first : first * std::pow(last / first, static_cast<double>(i) / (count - 1)));
  return steps;
}

}  // namespace ehm::tuner_design
