// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <unsupported/Eigen/MatrixFunctions>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/model/thermo/ram.h"
#include "engine_sim/model/units.h"
#include "monitor/schedule/point_lookup.h"
#include "tuner_design/envelope/envelope.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;
using schedule::Schedule;
using schedule::Variable;

std::string names_of(const LinearModel& m) {
  std::string names;
  for (const auto* kind : {&m.states, &m.controls, &m.health, &m.sensors, &m.auxiliary})
    for (const auto& channel : *kind) names += channel.name + " [" + channel.unit + "] ";
  return names;
}

int fan_speed_state(const LinearModel& model) {
  for (std::size_t i = 0; i < model.states.size(); ++i)
    if (model.states[i].unit == "rpm") return static_cast<int>(i);
  return 0;
}

engine_sim::RamRatios ratios(const LinearModel& model) {
  const auto& p = *model.operating_point;
  return engine_sim::ram_ratios(p.altitude_m, p.mach, p.delta_isa_k);
}

double coordinate(const LinearModel& model, Variable variable, int speed) {
  switch (variable) {
    case Variable::n1_corrected:
      return model.states[as_size(speed)].trim / std::sqrt(ratios(model).theta);
    case Variable::mach:
      return model.operating_point->mach;
    case Variable::t2:
      return ratios(model).theta * engine_sim::reference_temperature_k;
    case Variable::altitude:
      return model.operating_point->altitude_m;
  }
  return 0.0;
}

/// In continuous time: A = ln(Ad)/dt, B = A (Ad - I)^-1 Bd.
void make_continuous(LinearModel& model) {
  if (!model.discrete) return;
  const Eigen::MatrixXd a = model.A.log() / model.sample_time_s;
  const Eigen::MatrixXd over =
      a * (model.A - Eigen::MatrixXd::Identity(model.A.rows(), model.A.cols())).partialPivLu().inverse();
  model.B = over * model.B;
  model.L = over * model.L;
  model.A = a;
  model.discrete = false;
}

/// What is missed of readings: the model's linearisation error where it states one, else a share of what health does.
Eigen::VectorXd missed(const LinearModel& model, double error_of_slopes) {
  const Eigen::Index m = model.C.rows(), r = model.F.rows();
  if (model.linearisation_error.size() > 0) return model.linearisation_error.diagonal().cwiseMax(0.0).cwiseSqrt();
  const Eigen::MatrixXd settled = -model.A.partialPivLu().solve(model.L);
  Eigen::MatrixXd by_health(m + r, model.L.cols());
  by_health << model.C * settled + model.M, model.F * settled + model.N;
  return error_of_slopes * (by_health * model.health_sigma.asDiagonal()).rowwise().norm();
}

schedule::Node node_of(LinearModel model, double error_of_slopes) {
  make_continuous(model);
  const Eigen::VectorXd percent = linear_model::scaling_of(model).health;
  const Eigen::VectorXd lambda = missed(model, error_of_slopes);
  schedule::Node node{true,
                      linear_model::trims(model.states),
                      linear_model::trims(model.controls),
                      linear_model::trims(model.sensors),
                      linear_model::trims(model.auxiliary),
                      model.A,
                      model.B,
                      model.L * percent.asDiagonal(),
                      model.C,
                      model.D,
                      model.M * percent.asDiagonal(),
                      model.F,
                      model.G,
                      model.N * percent.asDiagonal(),
                      Eigen::VectorXd::Zero(model.A.rows()),
                      lambda.head(model.C.rows()),
                      lambda.tail(model.F.rows())};
  return node;
}

std::vector<double> distinct(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> points;
  for (const double v : values)
    if (points.empty() || v - points.back() > 1e-6 * std::max(1.0, std::abs(v))) points.push_back(v);
  return points;
}

}  // namespace

Schedule schedule_of_models(const std::vector<LinearModel>& models, const std::vector<Variable>& variables,
                            double error_of_slopes) {
  if (models.size() < 2) throw std::invalid_argument("a schedule needs two models or more");
  Schedule s;
  s.reduced = false;
  s.fan_speed_state = fan_speed_state(models.front());
  for (const LinearModel& model : models) {
    if (!model.operating_point)
      throw std::invalid_argument("model '" + model.name + "' does not state its operating_point");
    if (names_of(model) != names_of(models.front()))
      throw std::invalid_argument("model '" + model.name + "' has the channels " + names_of(model) +
                                  "; the first has " + names_of(models.front()));
  }
  for (const Variable variable : variables) {
    std::vector<double> values;
    for (const LinearModel& model : models) values.push_back(coordinate(model, variable, s.fan_speed_state));
    s.axes.push_back({variable, distinct(values)});
  }
  // Readings as they are: what a user's points lie apart in altitude is in their trims.
  s.states.resize(models.front().states.size()), s.actuators.resize(models.front().controls.size());
  s.sensors.resize(models.front().sensors.size()), s.auxiliary.resize(models.front().auxiliary.size());
  constexpr double eta_of_reading = 0.1;
  s.eta_y.setConstant(as_index(s.sensors.size()), eta_of_reading);
  s.eta_z.setZero(as_index(s.auxiliary.size()));
  std::size_t count = 1;
  for (const auto& axis : s.axes) count *= axis.points.size();
  if (count != models.size())
    throw std::invalid_argument(
        std::to_string(models.size()) + " models fill no grid of " + std::to_string(count) +
        " points by the variables; name others (--variables), or add the models that are missing");
  s.nodes.resize(count);
  for (const LinearModel& model : models) {
    std::size_t at = 0, stride = 1;
    for (const auto& axis : s.axes) {
      const double x = coordinate(model, axis.variable, s.fan_speed_state);
      const auto nearest = std::min_element(axis.points.begin(), axis.points.end(),
                                            [&](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
      at += stride * static_cast<std::size_t>(nearest - axis.points.begin());
      stride *= axis.points.size();
    }
    if (s.nodes[at].valid) throw std::invalid_argument("model '" + model.name + "' is at the place of another one");
    s.nodes[at] = node_of(model, error_of_slopes);
  }
  const schedule::PointLookup fits(s);
  return s;
}

}  // namespace ehm::tuner_design
