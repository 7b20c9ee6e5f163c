// SPDX-License-Identifier: Apache-2.0
#include "monitor/nonlinear/engine_state_space.h"

#include <cmath>
#include <utility>

#include "engine_sim/model/units.h"
#include "monitor/onboard/start_motion.h"

namespace ehm::nonlinear {
namespace {

namespace sim = engine_sim;
using onboard::speed_count;

/// Of a point's flow balances: some 1e-5 %, where a sensor's noise is 0.1 %. What the reference itself is solved to is
/// flow_balance.h's.
constexpr double point_tolerance = 1e-7;

}  // namespace

EngineStateSpace::EngineStateSpace(std::shared_ptr<const onboard::OnBoardModel> model, Metal metal)
    : model_(std::move(model)),
      channels_(model_),
      order_(speed_count + as_index(model_->definition().channels.health.size())),
      sensor_count_(as_index(model_->sensors().size())),
      with_metal_(metal == Metal::with),
      engine_(model_->engine()),
      output_slopes_(OutputSlopes::Zero(as_index(model_->auxiliary().size()), order_)),
      reference_(OrderVector::Zero(order_)),
      renewed_at_(reference_),
      reference_outputs_(estimation::AuxiliaryVector::Zero(as_index(model_->auxiliary().size()))) {}

void EngineStateSpace::set(const estimation::Conditions& now) noexcept {
  operation_ = sim::Operation{.flight = {now.flight.altitude_m, now.flight.mach, now.flight.delta_isa_k}};
  const auto& controls = model_->definition().channels.controls;
  for (std::size_t i = 0; i < controls.size(); ++i) controls[i]->of(operation_) = now.actuators(as_index(i));
}

sim::Operation EngineStateSpace::operation_at(const OrderVector& x) const noexcept {
  sim::Operation operation = operation_;
  const auto& health = model_->definition().channels.health;
  for (std::size_t i = 0; i < health.size(); ++i)
    operation.health[health[i].parameter] = 0.01 * x(speed_count + as_index(i));
  return operation;
}

sim::SpoolSpeeds EngineStateSpace::speeds_at(const OrderVector& x) const noexcept {
  return {x(0) * channels_.speed_unit()(0), x(1) * channels_.speed_unit()(1)};
}

void EngineStateSpace::tell(const sim::GasPath& gas, const OrderVector& x, Response& response) const noexcept {
  const double dt_s = model_->options().sample_time_s;
  const Eigen::Vector2d rates = channels_.rates(gas);
  response.next = x;
  response.next.head<speed_count>() += dt_s * rates + 0.5 * dt_s * dt_s * speed_rates_ * rates;
  response.readings = channels_.readings(gas);
}

bool EngineStateSpace::respond(const OrderVector& x, Response& response) noexcept {
  const sim::Operation operation = operation_at(x);
  const sim::SpoolSpeeds speeds = speeds_at(x);
  sim::GasPath gas;
  sim::GasPathStatus status =
      engine_.evaluate_nearby(model_->engine(), operation, speeds, gas, metal(), point_tolerance);
  // far from the reference: all the way from the design point
  if (status == sim::GasPathStatus::no_solution) status = engine_.evaluate(operation, speeds, gas, metal());
  if (status != sim::GasPathStatus::ok) return false;
  tell(gas, x, response);
  return true;
}

bool EngineStateSpace::respond(const OrderVector& x, Response& response, Slopes& slopes) noexcept {
  sim::GasPath gas;
  sim::GasPathJacobian jacobian;
  if (engine_.evaluate(operation_at(x), speeds_at(x), gas, jacobian, metal()) != sim::GasPathStatus::ok) return false;
  estimation::BoundedMatrix<speed_count, max_order> rates(speed_count, order_);
  for (Eigen::Index k = 0; k < speed_count; ++k)
    channels_.slopes(jacobian, as_size(k), 1.0 / channels_.speed_unit()(k), rates.row(k));
  speed_rates_ = rates.leftCols<speed_count>();
  const double dt_s = model_->options().sample_time_s;
  slopes.f.setIdentity(order_, order_);
  slopes.f.topRows<speed_count>() += dt_s * (rates + 0.5 * dt_s * speed_rates_ * rates);
  slopes.g.resize(sensor_count_, order_);
  for (Eigen::Index i = 0; i < sensor_count_; ++i) {
    const onboard::QuantityPlace& at = model_->sensors()[as_size(i)];
    channels_.slopes(jacobian, at.place, at.sign, slopes.g.row(i));
  }
  for (Eigen::Index i = 0; i < output_slopes_.rows(); ++i) {
    const onboard::QuantityPlace& at = model_->auxiliary()[as_size(i)];
    channels_.slopes(jacobian, at.place, at.sign, output_slopes_.row(i));
  }
  age_samples_ = 0;
  renewed_at_ = x;
  take_reference(x, gas);
  tell(gas, x, response);
  return true;
}

void EngineStateSpace::take_reference(const OrderVector& x, const sim::GasPath& gas) noexcept {
  reference_ = x;
  reference_outputs_ = channels_.outputs(gas);
  if (balance_left_s_ > 0.0) metal_k_ = gas.metal_k;
  metal_rates_k_s_ = gas.metal_dot_k_s;
  n1_corrected_rpm_ = gas.speeds.n1_rpm / std::sqrt(gas.s2.tt_k / sim::reference_temperature_k);
}

bool EngineStateSpace::due(const OrderVector& x) const noexcept {
  const onboard::OnBoardOptions& o = model_->options();
  return age_samples_ < 0 || age_samples_ * o.sample_time_s >= o.refresh_time_s ||
         ((x - renewed_at_).head<speed_count>().cwiseQuotient(renewed_at_.head<speed_count>()).cwiseAbs().maxCoeff() >
          o.refresh_speed);
}

bool EngineStateSpace::refer(const OrderVector& x) noexcept {
  if (due(x)) {
    Response response;
    Slopes slopes;
    return respond(x, response, slopes);
  }
  sim::GasPath gas;
  if (engine_.evaluate(operation_at(x), speeds_at(x), gas, metal()) != sim::GasPathStatus::ok) return false;
  ++age_samples_;
  take_reference(x, gas);
  return true;
}

bool EngineStateSpace::start(const std::array<double, speed_count>& measured_rpm, bool keep_metal,
                             OrderVector& x) noexcept {
  engine_.start(model_->engine().data().design.unknowns);
  age_samples_ = -1;
  speed_rates_.setZero();
  const auto motion = onboard::start_motion(*model_, operation_at(x), measured_rpm, engine_);
  if (!motion) return false;
  x(0) = motion->speeds.n1_rpm / channels_.speed_unit()(0);
  x(1) = motion->speeds.n2_rpm / channels_.speed_unit()(1);
  balance_left_s_ = keep_metal ? 0.0 : balance_s;
  if (!keep_metal) metal_k_ = motion->metal_k;
  return true;
}

void EngineStateSpace::advance_metal() noexcept {
  if (!with_metal_) return;
  const double dt_s = model_->options().sample_time_s;
  balance_left_s_ -= dt_s;
  for (std::size_t i = 0; i < metal_k_.size(); ++i) metal_k_[i] += dt_s * metal_rates_k_s_[i];
}

estimation::AuxiliaryVector EngineStateSpace::outputs(const OrderVector& x) const noexcept {
  return reference_outputs_ + output_slopes_ * (x - reference_);
}

}  // namespace ehm::nonlinear
