// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/monitor/cycle/flight.h"

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/design/design_tuner.h"

namespace ehm::test {

std::shared_ptr<const design::Design> made_up_design() {
  static const auto design =
      std::make_shared<const design::Design>(tuner_design::design_tuner(made_up_model(7, 10), design::DesignOptions{}));
  return design;
}

Flight::Flight(const linear_model::LinearModel& model, const Eigen::VectorXd& h, std::uint64_t seed)
    : model_(model),
      h_(h),
      x_(estimation::steady_gain(model).X * h),
      process_noise_sigma_(Eigen::VectorXd::Zero(x_.size())),
      random_(seed) {}

void Flight::start_moving() {
  process_noise_sigma_ = model_.process_noise.diagonal().cwiseSqrt();
  x_ += linear_model::covariance_root(linear_model::stationary_covariance(model_.A, model_.process_noise)) *
        random_.normal_vector(x_.size());
}

monitor::Sample Flight::next() {
  const Eigen::VectorXd noise =
      model_.sensor_noise_sigma.cwiseProduct(random_.normal_vector(model_.sensor_noise_sigma.size()));
  Eigen::VectorXd du = Eigen::VectorXd::Zero(model_.B.cols());
  if (du.size() > 0) du(0) = du_;
  const Eigen::VectorXd y = model_.C * x_ + model_.D * du + model_.M * h_ + noise;
  monitor::Sample s;
  s.schema = 1;
  s.sequence = sequence_;
  s.source_time_ns =
      static_cast<std::int64_t>(std::llround(1e9 * model_.sample_time_s * static_cast<double>(sequence_)));
  if (model_.operating_point) s.flight = *model_.operating_point;
  s.sensor_count = static_cast<std::uint32_t>(model_.sensors.size());
  s.sensor_valid = (1u << s.sensor_count) - 1u;
  s.actuator_count = static_cast<std::uint32_t>(model_.controls.size());
  for (std::size_t i = 0; i < model_.sensors.size(); ++i) s.sensor[i] = model_.sensors[i].trim + y(as_index(i));
  for (std::size_t i = 0; i < model_.controls.size(); ++i)
    s.actuator[i] = model_.controls[i].trim + (i == 0 ? du_ : 0.0);
  x_ = model_.A * x_ + model_.B * du + model_.L * h_;
  if (!process_noise_sigma_.isZero(0.0)) x_ += process_noise_sigma_.cwiseProduct(random_.normal_vector(x_.size()));
  ++sequence_;
  return s;
}

Eigen::VectorXd Flight::auxiliary() const {
  Eigen::VectorXd z = model_.F * x_ + model_.G.col(0) * du_ + model_.N * h_;
  for (std::size_t i = 0; i < model_.auxiliary.size(); ++i) z(as_index(i)) += model_.auxiliary[i].trim;
  return z;
}

}  // namespace ehm::test
