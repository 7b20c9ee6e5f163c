// The report in words.

#include <Eigen/SVD>
#include <cmath>

#include "tuner_design/design_tuner.h"
#include "tuner_design/report/sections.h"
#include "tuner_design/report/text.h"

namespace ehm::bench::report {
namespace {

std::string what_was_designed(const ReportData& data) {
  const auto& model = data.design.model;
  const std::size_t m = model.sensors.size(), p = model.health.size();
  const auto t = static_cast<std::size_t>(data.design.full.V.rows());
  const std::string outputs =
      model.auxiliary.empty() ? "" : " and " + counted(model.auxiliary.size(), "auxiliary output");
  if (t == p) {
    return "This filter estimates " + counted(p, "health parameter") + outputs + " of “" + model.name + "” from " +
           counted(m, "sensor") + ". The sensors tell all health parameters apart, so none of them had to be combined.";
  }
  return "This filter estimates " + counted(p, "health parameter") + outputs + " of “" + model.name + "” from " +
         counted(m, "sensor") + ". That many sensors cannot tell the health parameters apart, so the filter follows " +
         counted(t, "combination") + " of them, the tuners, and reconstructs each parameter from these.";
}

std::string against_limit(double ssee, double limit, const std::string& what, const std::string& unit) {
  // a limit that is only round-off beside the error is none
  if (limit <= 1e-9 * ssee)
    return "The expected squared error of " + what + " is " + number(ssee) + unit +
           ", all of it noise and lag: endless averaging would leave nothing.";
  return "The expected squared error of " + what + " is " + number(ssee) + unit + ", " + number(ssee / limit, 4) +
         " times the Bayes limit of " + number(limit) + unit + ".";
}

std::string how_near(const ReportData& data) {
  const auto& design = data.design;
  std::string text = against_limit(design.ssee.health.sum(), design.bayes_limit.health.sum(), "health", " percent²");
  if (!design.model.auxiliary.empty())
    text += " " + against_limit(design.ssee.auxiliary.sum(), design.bayes_limit.auxiliary.sum(),
                                "the auxiliary outputs", " (mixed units)");
  text += " No estimator that sees only steady data of this operating point can pass that limit.";
  const double nonlinear = design.linearisation.health.sum();
  if (nonlinear > 0.0)
    text += " What the linear model misses of the real engine adds " + number(nonlinear) + " percent² of health.";
  return text;
}

/// Largest principal angle between the row space of V and that of H Ph, degrees.
double angle_to_closed_form(const ReportData& data) {
  const Eigen::MatrixXd Ph = data.model.health_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd V = row_space(data.design.full.V), closed = row_space(data.steady.H * Ph);
  // sin of the angles: V (I - closed^T closed), accurate for small ones
  const Eigen::MatrixXd outside = V - V * closed.transpose() * closed;
  const double sine = Eigen::JacobiSVD<Eigen::MatrixXd>(outside).singularValues()(0);
  return std::asin(std::min(1.0, sine)) * 180.0 / M_PI;
}

std::string is_it_optimal(const ReportData& data) {
  const Eigen::Index t = data.design.full.V.rows(), m = data.steady.H.rows(), p = data.steady.H.cols();
  if (t == p) return "There is no choice of tuners to be made, and so no better one.";
  const double angle = angle_to_closed_form(data);
  constexpr double same_degrees = 1e-4;
  if (angle > same_degrees)
    return "The tuners depart by up to " + number(angle) +
           "° from H Ph, the closed form that has the least bias of all.";
  if (t == m)
    return "The tuners span H Ph, the closed form: no other choice has less bias, for health and for every auxiliary "
           "output at once. What is above the limit is noise and lag, the price of the response time.";
  return "The tuners lie in H Ph, the closed form with the least bias; of the " + std::to_string(m) +
         " combinations that it offers " + std::to_string(m - t) + (m - t == 1 ? " is" : " are") +
         " left out, because the linear model errs more there than the sensors could tell. That costs part of the "
         "distance to the limit.";
}

std::string warning(const ReportData& data) {
  const auto worse = worse_than_prior(data.design.full, data.design.model, data.design.scaling);
  if (worse.empty()) return "";
  return "Warning: for " + listed(worse) +
         " the estimate is worse than knowing nothing (sigma above the fleet's own). Lower Qh, or remove what the "
         "sensors hardly see.";
}

}  // namespace

Section summary_section(const ReportData& data) {
  const auto& design = data.design;
  Section section{"summary", "Summary"};
  section.add_text(what_was_designed(data) + " " + how_near(data) + " " + is_it_optimal(data) +
                   " A change of the engine shows with a slowest time constant of " +
                   number(design.full.slowest_time_constant_s) + " s.");
  const std::string care = warning(data);
  if (!care.empty()) section.add_text(care);
  std::vector<KeyFigure> key;
  const double limit = design.bayes_limit.health.sum(), ssee = design.ssee.health.sum();
  if (limit > 1e-9 * ssee) {
    key.push_back({number(ssee / limit, 4), "× limit", "squared error of health"});
  } else {
    key.push_back({number(ssee), "percent²", "squared error of health"});
  }
  if (!design.model.auxiliary.empty()) {
    const double limit_z = design.bayes_limit.auxiliary.sum(), ssee_z = design.ssee.auxiliary.sum();
    const bool has_limit = limit_z > 1e-9 * ssee_z;
    key.push_back({number(has_limit ? ssee_z / limit_z : ssee_z, has_limit ? 4 : 3), has_limit ? "× limit" : "mixed",
                   "squared error of auxiliary outputs"});
  }
  const double prior = data.health.prior.sum(), total = data.health.total.sum();
  key.push_back({number(100.0 * (1.0 - total / prior), 3), "%", "of the fleet's health variance explained"});
  key.push_back({number(design.full.slowest_time_constant_s), "s", "slowest time constant"});
  section.add_key_figures(key);
  return section;
}

}  // namespace ehm::bench::report
