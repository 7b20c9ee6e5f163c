// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/model_error.h"

#include <cmath>

#include "engine_sim/linear_model/discretise.h"
#include "tuner_design/endurthi/linear_models.h"
#include "tuner_design/linearise/open_loop.h"

namespace ehm::tuner_design::endurthi {
namespace {

/// States of the linear engine, n x samples.
Eigen::MatrixXd linear_states(const linear_model::LinearModel& discrete, const Record& record) {
  Eigen::MatrixXd x(record.x0.size(), record.u.cols());
  x.col(0) = record.x0;
  const Eigen::VectorXd by_health = discrete.L * record.h;
  for (Eigen::Index k = 0; k + 1 < x.cols(); ++k)
    x.col(k + 1) = discrete.A * x.col(k) + discrete.B * record.u.col(k) + by_health;
  return x;
}

}  // namespace

Eigen::MatrixXd missed_by(const Plant& plant, const Eigen::MatrixXd& jacobian, const Record& record) {
  const linear_model::LinearModel model = discretise(linear_model_of(plant, jacobian, record.step_s));
  Eigen::MatrixXd missed = model.C * linear_states(model, record) + model.D * record.u - record.y;
  missed.colwise() += model.M * record.h;
  return missed;
}

ModelError error_of(const Plant& plant, const Eigen::MatrixXd& jacobian, const Record& record, double percent) {
  const Eigen::MatrixXd missed = missed_by(plant, jacobian, record);
  const Eigen::VectorXd percent_of_trim = 100.0 * plant.f0.tail(missed.rows()).cwiseAbs().cwiseInverse();
  const Eigen::RowVectorXd e = (percent_of_trim.asDiagonal() * missed).colwise().norm() /
                               std::sqrt(static_cast<double>(missed.rows())) / std::abs(percent);
  return {e.mean(), e(e.size() - 1)};
}

Plant with_corner(const Plant& plant, double corner, double steeper) {
  Plant kinked = plant;
  kinked.f = [f = plant.f, first = plant.first_health(), corner, steeper](const Eigen::VectorXd& v) {
    Eigen::VectorXd felt = v;
    for (Eigen::Index j = first; j < v.size(); ++j)
      if (v(j) < corner) felt(j) += steeper * (v(j) - corner);
    return f(felt);
  };
  return kinked;
}

Record open_loop(const Plant& plant, const Eigen::VectorXd& states, const Eigen::VectorXd& health, double seconds,
                 double step_s) {
  const auto samples = static_cast<Eigen::Index>(std::lround(seconds / step_s)) + 1;
  Record record{.step_s = step_s,
                .x0 = states,
                .h = health,
                .u = Eigen::MatrixXd::Zero(plant.controls, samples),
                .y = Eigen::MatrixXd(plant.outputs() - plant.states, samples)};
  Eigen::VectorXd v = plant.v0;
  v.head(plant.states) += states;
  v.tail(plant.health) += health;
  for (Eigen::Index k = 0; k < samples; ++k) {
    record.y.col(k) = (plant.f(v) - plant.f0).tail(record.y.rows());
    v = after(plant, v, step_s);
  }
  return record;
}

}  // namespace ehm::tuner_design::endurthi
