// SPDX-License-Identifier: Apache-2.0
// The report in words.

#include <algorithm>

#include "deploy/runtime/numbers/index.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/report/limit_ratio.h"
#include "tuner_design/report/page/text.h"
#include "tuner_design/report/sections/sections.h"

namespace ehm::tuner_design::report {
namespace {

std::string what_was_designed(const ReportData& data) {
  const auto& model = data.design.model;
  const std::size_t m = model.sensors.size(), p = model.health.size();
  const auto t = as_size(data.design.full.V.rows());
  const std::string outputs =
      model.auxiliary.empty() ? "" : " and " + counted(model.auxiliary.size(), "auxiliary output");
  if (t == p) {
    return "This filter estimates " + counted(p, "health parameter") + outputs + " of “" + model.name + "” from " +
           counted(m, "sensor") + ". The sensors tell all health parameters apart, so none of them had to be combined.";
  }
  return "This filter estimates " + counted(p, "health parameter") + outputs + " of “" + model.name + "” from " +
         counted(m, "sensor") + ". These cannot tell the health parameters apart, so the filter follows " +
         counted(t, "combination") + " of them, the tuners.";
}

std::string how_near(const ReportData& data) {
  const auto& design = data.design;
  const design::ErrorByChannel real = design.real_error();
  const double h = real.health.sum(), limit_h = design.bayes_limit.health.sum();
  const double z = real.auxiliary.sum(), limit_z = design.bayes_limit.auxiliary.sum();
  std::string text = "The expected squared error of health is " + quantity(h, "percent²");
  if (has_limit(h, limit_h)) {
    text += ", " + number(h / limit_h, 4) + " times the Bayes limit";
    if (!design.model.auxiliary.empty() && has_limit(z, limit_z))
      text += "; that of the auxiliary outputs is " + number(z / limit_z, 4) + " times theirs";
    text += ". No linear estimator that sees only steady data of this operating point can pass these limits.";
  } else {
    text += ", all of it noise and lag: endless averaging would leave nothing.";
  }
  const double nonlinear = design.linearisation.health.sum();
  if (nonlinear > 0.0)
    text += " Of it " + quantity(nonlinear, "percent²") + " is what the linear model misses of the real engine.";
  return text;
}

std::string is_it_optimal(const ReportData& data) {
  const design::Certificate& certificate = data.design.certificate;
  const auto t = data.design.full.V.rows(), p = data.design.full.V.cols();
  if (t == p) return "There is no choice of tuners to be made, and so no better one.";
  std::string text = certificate.at_optimum ? "The choice of the tuners is " : "Mind that the choice of the tuners is ";
  text += certificate.verdict + ".";
  if (certificate.at_optimum)
    text += " What is above the limit is the price of the response time" +
            std::string(certificate.points.size() > 1 ? " and of one V* for all points" : "") +
            std::string(
                t < std::min(data.steady.H.rows(), p)
                    ? ", and of combinations left out because the linear model errs more there than the sensors see."
                    : ".");
  return text;
}

std::string warning(const ReportData& data) {
  const auto worse = worse_than_prior(data.design.full, data.design.model, data.design.scaling);
  if (worse.empty()) return "";
  return "Warning: for " + listed(worse) +
         " the estimate is worse than knowing nothing (sigma above the fleet's own). Lower Qh, or remove what the "
         "sensors hardly see.";
}

KeyFigure against_limit(double ssee, double limit, const std::string& unit, const std::string& meaning) {
  if (has_limit(ssee, limit)) return {number(ssee / limit, 4), "× limit", meaning};
  return {number(ssee), unit, meaning};
}

}  // namespace

Section summary_section(const ReportData& data) {
  const auto& design = data.design;
  Section section{"summary", "Summary"};
  section.add_text(what_was_designed(data) + " " + how_near(data) + " " + is_it_optimal(data) +
                   " A change of the engine shows with a slowest time constant of " +
                   quantity(design.full.slowest_time_constant_s, "s") + ".");
  const std::string care = warning(data);
  if (!care.empty()) section.add_text(care);
  const design::ErrorByChannel real = design.real_error();
  std::vector<KeyFigure> key{
      against_limit(real.health.sum(), design.bayes_limit.health.sum(), "percent²", "squared error of health")};
  if (!design.model.auxiliary.empty())
    key.push_back(against_limit(real.auxiliary.sum(), design.bayes_limit.auxiliary.sum(), "mixed units",
                                "squared error of auxiliary outputs"));
  const double prior = data.health.prior.sum(), total = data.health.total.sum();
  key.push_back({number(100.0 * (1.0 - total / prior), 3), "%", "of the fleet's health variance explained"});
  key.push_back({number(design.full.slowest_time_constant_s), "s", "slowest time constant"});
  section.add_key_figures(key);
  return section;
}

}  // namespace ehm::tuner_design::report
