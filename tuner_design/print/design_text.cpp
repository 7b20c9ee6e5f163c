// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/print/design_text.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/certificate_json.h"
#include "monitor/design/options_json.h"
#include "tuner_design/design/design_tuner.h"
#include "tuner_design/design/tuner_number.h"
#include "tuner_design/print/certificate_text.h"
#include "tuner_design/print/check_text.h"
#include "tuner_design/print/error_text.h"
#include "tuner_design/search/row_space.h"

namespace ehm::tuner_design {
namespace {

using Json = nlohmann::ordered_json;
using design::Design;
using design::SubsetDesign;
using linear_model::Channel;

Json rows(const Eigen::MatrixXd& matrix) {
  Json result = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(matrix(i, j));
    result.push_back(std::move(row));
  }
  return result;
}

bool reduces(const Design& design) {
  return design.full.V.rows() < design.full.V.cols();
}

Json missing_as_json(const Design& design) {
  Json result = Json::object();
  for (std::size_t i = 0; i < design.missing.size(); ++i) {
    const std::string& name = design.model.sensors[i].name;
    if (!design.missing[i]) {
      result[name] = nullptr;
      continue;
    }
    const SubsetDesign& subset = *design.missing[i];
    result[name] = {
        {"tuners", subset.V.rows()},
        {"ssee_health", errors_as_json(subset.health_total_covariance.diagonal(), design.model.health)},
        {"ssee_auxiliary", errors_as_json(subset.auxiliary_total_covariance.diagonal(), design.model.auxiliary)},
        {"slowest_time_constant_s", subset.slowest_time_constant_s}};
  }
  return result;
}

std::string ratio(double ssee, double limit) {
  return limit > 0.0 ? figure(ssee / limit, 0) : "(the limit is 0)";
}

void print_errors(const Design& design, std::ostream& out) {
  std::size_t width = 8;
  for (const Channel& channel : design.model.health) width = std::max(width, channel.name.size());
  for (const Channel& channel : design.model.auxiliary) width = std::max(width, channel.name.size());
  const auto line = [&](const std::string& name, double ssee, double limit, double map, double more,
                        const std::string& unit) {
    out << "  " << std::left << std::setw(static_cast<int>(width)) << name << std::right << figure(ssee)
        << figure(limit) << figure(map) << figure(more) << figure(std::sqrt(ssee + more)) << "  " << unit << '\n';
  };
  const auto head = [&](const std::string& what) {
    out << '\n'
        << "  " << std::left << std::setw(static_cast<int>(width)) << what << std::right << std::setw(11) << "SSEE"
        << std::setw(11) << "limit" << std::setw(11) << "full MAP" << std::setw(11) << "nonlinear" << std::setw(11)
        << "sigma"
        << "  sigma in\n";
  };
  head("health");
  for (std::size_t i = 0; i < design.model.health.size(); ++i) {
    const auto at = as_index(i);
    line(design.model.health[i].name, design.ssee.health(at), design.bayes_limit.health(at), design.full_map.health(at),
         design.linearisation.health(at), "percent");
  }
  line("total", design.ssee.health.sum(), design.bayes_limit.health.sum(), design.full_map.health.sum(),
       design.linearisation.health.sum(), "percent");
  if (design.model.auxiliary.empty()) return;
  head("auxiliary");
  for (std::size_t i = 0; i < design.model.auxiliary.size(); ++i) {
    const auto at = as_index(i);
    line(design.model.auxiliary[i].name, design.ssee.auxiliary(at), design.bayes_limit.auxiliary(at),
         design.full_map.auxiliary(at), design.linearisation.auxiliary(at), design.scaling.auxiliary_unit[i]);
  }
  line("total", design.ssee.auxiliary.sum(), design.bayes_limit.auxiliary.sum(), design.full_map.auxiliary.sum(),
       design.linearisation.auxiliary.sum(), "mixed");
}

/// Health parameter with the largest sigma.
Eigen::Index worst_channel(const Design& design) {
  Eigen::Index worst = 0;
  design.full.health_total_covariance.diagonal().maxCoeff(&worst);
  return worst;
}

void print_missing(const Design& design, std::ostream& out) {
  out << "\n  without sensor     tuners     SSEE(h)     SSEE(z)  slowest time constant, s\n";
  for (std::size_t i = 0; i < design.missing.size(); ++i) {
    out << "  " << std::left << std::setw(16) << design.model.sensors[i].name << std::right;
    if (!design.missing[i]) {
      out << "  no design: no tuners keep sigma within the fleet's own\n";
      continue;
    }
    const SubsetDesign& subset = *design.missing[i];
    out << std::setw(9) << subset.V.rows() << figure(subset.health_total_covariance.trace(), 12)
        << figure(subset.auxiliary_total_covariance.trace(), 12) << figure(subset.slowest_time_constant_s, 12) << '\n';
  }
}

}  // namespace

std::string reduction(const Design& design) {
  if (!reduces(design)) return "none, V = I: at least as many sensors as health parameters";
  const std::string why = design.model.sensors.size() < design.model.health.size()
                              ? ": fewer sensors than health parameters"
                              : ": the sensors see fewer combinations of health than there are parameters";
  switch (design.options.tuning) {
    case design::Tuning::closed_form:
      return "closed form, V = H Ph" + why;
    case design::Tuning::kalman:
      return "search for the least error of the Kalman filter" + why;
    case design::Tuning::map:
      return "search for the least error of the MAP estimator" + why;
  }
  return "?";
}

Json design_as_json(const Design& design) {
  const auto& health = design.model.health;
  const auto& auxiliary = design.model.auxiliary;
  Json units = Json::object();
  for (std::size_t i = 0; i < auxiliary.size(); ++i) units[auxiliary[i].name] = design.scaling.auxiliary_unit[i];
  Json sensors = Json::array();
  for (const Channel& sensor : design.model.sensors) sensors.push_back(sensor.name);
  return {{"name", design.model.name},
          {"hash", design.hash},
          {"sensors", std::move(sensors)},
          {"blind_sensors", blind_sensors(design.model, design.full.sensors)},
          {"tuners", design.full.V.rows()},
          {"reduction", reduction(design)},
          {"qh_percent2", design.options.qh_percent2},
          {"sample_time_s", design.model.sample_time_s},
          {"slowest_time_constant_s", design.full.slowest_time_constant_s},
          {"ssee_health", errors_as_json(design.ssee.health, health)},
          {"ssee_auxiliary", errors_as_json(design.ssee.auxiliary, auxiliary)},
          {"linearisation_error_health", errors_as_json(design.linearisation.health, health)},
          {"linearisation_error_auxiliary", errors_as_json(design.linearisation.auxiliary, auxiliary)},
          {"bayes_limit_health", errors_as_json(design.bayes_limit.health, health)},
          {"bayes_limit_auxiliary", errors_as_json(design.bayes_limit.auxiliary, auxiliary)},
          {"full_map_health", errors_as_json(design.full_map.health, health)},
          {"full_map_auxiliary", errors_as_json(design.full_map.auxiliary, auxiliary)},
          {"reduced_map_health", errors_as_json(design.reduced_map.health, health)},
          {"reduced_map_auxiliary", errors_as_json(design.reduced_map.auxiliary, auxiliary)},
          {"worse_than_prior", worse_than_prior(design.full, design.model, design.scaling)},
          {"auxiliary_unit", std::move(units)},
          {"row_space", rows(row_space(design.full.V))},
          {"tuning", design::name_of(design.options.tuning)},
          {"certificate", design::certificate_to_json(design.certificate, design.model.name)},
          {"without_sensor", missing_as_json(design)}};
}

void print_design(const Design& design, std::ostream& out) {
  out << "Design for " << design.model.name << ": " << design.model.states.size() << " states, "
      << design.model.sensors.size() << " sensors, " << design.model.health.size() << " health parameters, "
      << design.model.auxiliary.size() << " auxiliary outputs, " << design.full.V.rows() << " tuners\n"
      << "Reduction: " << reduction(design) << '\n';
  print_blind(blind_sensors(design.model, design.full.sensors), out);
  out << "Scaling: states and sensors in percent of trim, health in percent, temperatures in K, margins in points,\n"
      << "         other auxiliary outputs in percent of trim; SSEE is squared error over the fleet in these units\n"
      << "Qh " << design.options.qh_percent2 << " percent^2 per sample of " << design.model.sample_time_s
      << " s; slowest time constant " << figure(design.full.slowest_time_constant_s, 0) << " s\n";
  print_errors(design, out);
  print_missing(design, out);
  const design::ErrorByChannel real = design.real_error();
  out << "\n  " << (design.linearisation.health.sum() > 0.0 ? "(SSEE + nonlinear)" : "SSEE") << " / limit: health "
      << ratio(real.health.sum(), design.bayes_limit.health.sum());
  if (!design.model.auxiliary.empty()) {
    out << ", auxiliary " << ratio(real.auxiliary.sum(), design.bayes_limit.auxiliary.sum());
  }
  out << '\n';
  print_certificate(design.certificate, out);
  print_detectability(design.model, design.certificate.slow_bias_detectability, out);
  const std::vector<std::string> worse = worse_than_prior(design.full, design.model, design.scaling);
  if (worse.empty()) return;
  out << "  warning: sigma exceeds the fleet's own for";
  for (const std::string& name : worse) out << ' ' << name;
  const Eigen::Index at = worst_channel(design);
  const bool noise = design.ssee.health(at) > design.linearisation.health(at);
  out << (noise ? "; lower --qh, or remove what the sensors hardly see\n"
                : "; mostly what the linear model misses of the engine: linearise nearer to where it runs\n");
}

}  // namespace ehm::tuner_design
