// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/health_filter.h"

#include <limits>

#include "engine_sim/linear_model/discretise.h"
#include "monitor/estimation/constrained/box_projection.h"
#include "tuner_design/endurthi/linear_models.h"

namespace ehm::tuner_design::endurthi {
namespace {

using estimation::HealthVector;

constexpr double percent = 100.0;

/// diag(percent/rows) M diag(columns/percent): from channel units.
Eigen::MatrixXd in_percent(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rows, const Eigen::VectorXd& columns) {
  return rows.cwiseInverse().asDiagonal() * matrix * columns.asDiagonal();
}

/// [x; h] as states that all may move.
estimation::FullOrderModel augmented_model(const StudyPoint& point, const Eigen::MatrixXd& jacobian,
                                           const FilterSettings& settings) {
  const linear_model::LinearModel model = discretise(linear_model_of(point.plant, jacobian, settings.sample_time_s));
  const Eigen::Index n = point.plant.states, p = point.plant.health, m = point.sensors(), nu = point.plant.controls;
  const Eigen::VectorXd x = point.plant.v0.head(n) / percent, y = point.sensor_trim() / percent,
                        h = Eigen::VectorXd::Constant(p, 1.0 / percent), u = Eigen::VectorXd::Ones(nu);
  estimation::FullOrderModel full;
  full.A.setIdentity(n + p, n + p);
  full.A.topRows(n) << in_percent(model.A, x, x), in_percent(model.L, x, h);
  full.B.setZero(n + p, nu);
  full.B.topRows(n) = in_percent(model.B, x, u);
  full.L.resize(n + p, 0);
  full.sensor_output.resize(m, n + p);
  full.sensor_output << in_percent(model.C, y, x), in_percent(model.M, y, h);
  full.D = in_percent(model.D, y, u);
  full.auxiliary_output.resize(0, n + p);
  full.G.resize(0, nu);
  Eigen::VectorXd noise(n + p);
  noise << Eigen::VectorXd::Constant(n, settings.process_noise_percent * settings.process_noise_percent),
      Eigen::VectorXd::Constant(p, settings.qh_percent2);
  full.process_noise = noise.asDiagonal();
  full.sensor_noise_variance = point.noise_sigma.cwiseQuotient(y).cwiseAbs2();
  full.prior = Eigen::VectorXd::Constant(n + p, settings.p0_percent * settings.p0_percent).asDiagonal();
  full.sensor_offset.resize(m, 0);
  full.auxiliary_offset.resize(0, 0);
  return full;
}

HealthVector directions(const StudyPoint& point) {
  HealthVector direction(point.plant.health);
  Eigen::Index i = 0;
  for (const std::string& name : point.health_names()) direction(i++) = estimation::wear_direction(name);
  return direction;
}

}  // namespace

HealthFilter::HealthFilter(const StudyPoint& point, const Eigen::MatrixXd& jacobian, FilterKind kind,
                           const FilterSettings& settings)
    : kind_(kind),
      settings_(settings),
      state_trim_(point.plant.v0.head(point.plant.states)),
      health_trim_(percent * point.plant.v0.tail(point.plant.health)),
      sensor_trim_(point.sensor_trim()),
      control_trim_(point.control_trim()),
      filter_(augmented_model(point, jacobian, settings)),
      constraint_(directions(point)),
      health_(health_trim_) {
  constraint_.take(HealthVector::Zero(health_trim_.size()));  // the engine is new
}

void HealthFilter::fuse(const Eigen::VectorXd& y, const Eigen::VectorXd& u) {
  if (begun_) filter_.predict(du_previous_);
  begun_ = true;
  du_previous_ = u - control_trim_;
  filter_.innovation(percent * (y - sensor_trim_).cwiseQuotient(sensor_trim_), du_previous_);
  filter_.update(~estimation::SensorMask());
  health_ = health_trim_ + filter_.estimate().tail(health_trim_.size());
  if (kind_ != FilterKind::unconstrained) constrain();
}

void HealthFilter::constrain() {
  const Eigen::Index n = state_trim_.size(), p = health_trim_.size();
  HealthVector lower = HealthVector::Constant(n + p, -std::numeric_limits<double>::infinity()), upper = -lower;
  lower.tail(p) = constraint_.lower() - health_trim_;
  upper.tail(p) = constraint_.upper() - health_trim_;
  HealthVector estimate = filter_.estimate();
  const estimation::HealthCovariance P = filter_.covariance();
  if (estimation::project_onto_box(P, lower, upper, estimate) != estimation::BoxSolution::found) return;
  health_ = health_trim_ + estimate.tail(p);
  if (kind_ == FilterKind::every_sample) constraint_.take(health_);
  if (kind_ == FilterKind::fed_back) filter_.restore(estimate, filter_.covariance(), filter_.offset());
}

void HealthFilter::end_flight() {
  if (kind_ != FilterKind::unconstrained) constraint_.take(health_);
}

void HealthFilter::relinearise(const StudyPoint& point, const Eigen::MatrixXd& jacobian) {
  const Eigen::Index n = state_trim_.size(), p = health_trim_.size();
  const Eigen::VectorXd states = point.plant.v0.head(n), health = percent * point.plant.v0.tail(p);
  // absolute states stay: percent of the old trim to percent of the new one
  const Eigen::VectorXd ratio = state_trim_.cwiseQuotient(states);
  estimation::AugmentedVector estimate = filter_.estimate();
  estimate.head(n) = ratio.cwiseProduct(estimate.head(n)) + percent * (ratio - Eigen::VectorXd::Ones(n));
  estimate.tail(p) += health_trim_ - health;
  estimation::FullOrderCovariance covariance = filter_.covariance();
  covariance.topRows(n) = (ratio.asDiagonal() * covariance.topRows(n)).eval();
  covariance.leftCols(n) = (covariance.leftCols(n) * ratio.asDiagonal()).eval();
  filter_ = estimation::TimeVaryingFilter(augmented_model(point, jacobian, settings_));
  filter_.restore(estimate, covariance, filter_.offset());
  du_previous_ += control_trim_ - point.control_trim();
  state_trim_ = states;
  health_trim_ = health;
  sensor_trim_ = point.sensor_trim();
  control_trim_ = point.control_trim();
}

}  // namespace ehm::tuner_design::endurthi
