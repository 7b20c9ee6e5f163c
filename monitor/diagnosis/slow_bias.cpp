// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/slow_bias.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/design/closed_loop.h"
#include "monitor/design/detectability.h"
#include "monitor/diagnosis/quantiles.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

namespace {

constexpr double persistence_s = 5.0;
constexpr double clear_share = 0.7, rival_share = 0.8;
constexpr double ordinary_tail = 1e-3;

}  // namespace

std::shared_ptr<const SlowBiasTable> slow_bias_table(const design::Design& design) {
  auto table = std::make_shared<SlowBiasTable>();
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const Eigen::MatrixXd H = estimation::steady_gain(model).H;
  const Eigen::Index m = H.rows();
  const Eigen::MatrixXd HW = H * design.full.W;
  Eigen::MatrixXd spread = H * model.health_sigma.cwiseAbs2().asDiagonal() * H.transpose() +
                           HW * design::tuner_noise(design.full, model) * HW.transpose();
  if (model.linearisation_error.rows() > 0) spread += model.linearisation_error.topLeftCorner(m, m);
  // Fewer tuners than sensors leave directions that the filter never believes in: noise keeps them finite.
  const double samples = design.full.averaged_samples(model.sample_time_s);
  spread += Eigen::MatrixXd(model.sensor_noise_sigma.cwiseAbs2().asDiagonal()) / samples;
  const Eigen::MatrixXd inverse = spread.llt().solve(Eigen::MatrixXd::Identity(m, m));
  const Eigen::VectorXd root = inverse.diagonal().cwiseSqrt();
  table->whitened = root.cwiseInverse().asDiagonal() * inverse * HW;
  table->distance = HW.transpose() * inverse * HW;
  table->bias_per_z = design.scaling.sensor.cwiseQuotient(root);
  table->ordinary = chi_square_quantile(static_cast<double>(m), normal_quantile_above(ordinary_tail));
  const Eigen::VectorXd detectability = design::slow_bias_detectability(design.model, design.scaling, design.full);
  for (Eigen::Index i = 0; i < m; ++i) table->watched[as_size(i)] = detectability(i) > design::least_detectability;
  table->persistence_samples = std::llround(persistence_s / design.model.sample_time_s);
  return table;
}

SlowBias::SlowBias(const FaultOptions& options, std::shared_ptr<const SlowBiasTable> table)
    : table_(std::move(table)),
      threshold_(normal_quantile_above(0.5 * options.slow_bias_probability)),
      least_gain_(-2.0 * std::log(options.wrong_name_probability)),
      z_(estimation::SensorVector::Zero(table_->bias_per_z.size())),
      conditions_(as_size(table_->bias_per_z.size())) {}

bool SlowBias::drifted(int sensor, double distance2) const noexcept {
  const double z = std::abs(z_(sensor));
  if (z < threshold_ || distance2 - z * z > table_->ordinary) return false;
  for (Eigen::Index j = 0; j < z_.size(); ++j)
    if (j != sensor && std::abs(z_(j)) > rival_share * z) return false;
  return true;
}

void SlowBias::check(const estimation::TunerVector& tuners, EventList& events) noexcept {
  if (table_->watched.none()) return;
  z_.noalias() = table_->whitened.lazyProduct(tuners);
  const double distance2 = tuners.dot(table_->distance.lazyProduct(tuners));
  for (int i = 0; i < z_.size(); ++i) {
    const auto s = as_size(i);
    if (!table_->watched[s]) continue;
    Condition& condition = conditions_[s];
    above_[s] = drifted(i, distance2) ? above_[s] + 1 : 0;
    const bool now =
        condition.raised() ? std::abs(z_(i)) > clear_share * threshold_ : above_[s] > table_->persistence_samples;
    condition.set(now,
                  {.kind = idl::EventKind::slow_bias,
                   .channel = static_cast<std::uint32_t>(i),
                   .value = table_->bias_per_z(i) * z_(i),
                   .threshold = table_->bias_per_z(i) * threshold_},
                  events);
  }
}

bool SlowBias::ended_by(int sensor, double size) const noexcept {
  const double step = size / table_->bias_per_z(sensor);
  return watches(sensor) && -2.0 * z_(sensor) * step - step * step > least_gain_;
}

bool SlowBias::raised() const noexcept {
  return std::any_of(conditions_.begin(), conditions_.end(), [](const Condition& c) { return c.raised(); });
}

void SlowBias::reset(EventList& events) noexcept {
  above_.fill(0);
  for (std::size_t i = 0; i < conditions_.size(); ++i)
    conditions_[i].reassess(idl::EventKind::slow_bias, static_cast<std::uint32_t>(i), events);
}

}  // namespace ehm::monitor
