// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/engine_tangent.h"

#include <cmath>
#include <utility>

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;
using estimation::AuxiliaryVector;
using estimation::SensorVector;

}  // namespace

EngineTangent::EngineTangent(std::shared_ptr<const OnBoardModel> model)
    : model_(std::move(model)),
      layout_(*model_),
      channels_(model_),
      engine_(model_->engine()),
      rates_(Rates::Zero(speed_count, layout_.count())),
      readings_(Readings::Zero(layout_.sensor_count, layout_.count())),
      outputs_(Outputs::Zero(layout_.auxiliary_count, layout_.count())),
      metal_rates_(decltype(metal_rates_)::Zero()),
      metal_by_metal_(Eigen::Matrix3d::Zero()),
      metal_by_cause_(decltype(metal_by_cause_)::Zero()),
      settled_health_(HealthReadings::Zero(layout_.sensor_count, layout_.health_count)),
      direct_metal_readings_(MetalReadings::Zero(layout_.sensor_count, 3)),
      metal_readings_(direct_metal_readings_),
      direct_metal_outputs_(MetalOutputs::Zero(layout_.auxiliary_count, 3)),
      metal_outputs_(direct_metal_outputs_),
      path_variance_(SensorVector::Zero(layout_.sensor_count)),
      path_output_variance_(AuxiliaryVector::Zero(layout_.auxiliary_count)) {
  // each bias is of its own reading
  readings_.rightCols(layout_.sensor_count).setIdentity();
}

bool EngineTangent::due(const EngineMotion& motion) const noexcept {
  const OnBoardOptions& o = model_->options();
  return age_samples_ < 0 || age_samples_ * o.sample_time_s >= o.refresh_time_s ||
         std::abs(motion.speeds.n1_rpm / renewed_at_.n1_rpm - 1.0) > o.refresh_speed ||
         std::abs(motion.speeds.n2_rpm / renewed_at_.n2_rpm - 1.0) > o.refresh_speed;
}

bool EngineTangent::answer(const sim::Operation& operation, const EngineMotion& motion) noexcept {
  const sim::MetalTemperatures metal_k = effective_metal(motion);
  if (!due(motion)) {
    if (engine_.evaluate(operation, motion.speeds, gas_, &metal_k) != sim::GasPathStatus::ok) return false;
    ++age_samples_;
    measure_soak(motion);
  } else {
    sim::GasPathJacobian jacobian;
    if (engine_.evaluate(operation, motion.speeds, gas_, jacobian, &metal_k) != sim::GasPathStatus::ok) return false;
    const bool first = age_samples_ < 0;
    measure_soak(motion);
    renew(jacobian);
    renewed_at_ = motion.speeds;
    age_samples_ = 0;
    waiting_ = layout_.cause_count;
    // without a column a cause would count as none: at the start all of them at once
    while (first && waiting_ > 0) renew_cause(--waiting_, operation, motion);
    settle();
  }
  renew_soak_causes(motion);
  if (waiting_ > 0) {
    renew_cause(--waiting_, operation, motion);
    if (waiting_ == 0) settle();
  }
  return true;
}

void EngineTangent::renew(const sim::GasPathJacobian& jacobian) noexcept {
  const auto metal = [&](Eigen::Index row) {
    return jacobian.row(row).segment<3>(as_index(sim::gas_path_input::first_metal));
  };

  for (Eigen::Index k = 0; k < 3; ++k) metal_by_metal_.row(k) = metal(speed_count + k);
  for (Eigen::Index k = 0; k < speed_count; ++k) {
    channels_.slopes(jacobian, as_size(k), 1.0 / channels_.speed_unit()(k), rates_.row(k));
    metal_rates_.row(k) = metal(k) / channels_.speed_unit()(k);
  }
  const SensorVector y = readings_of(gas_);
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) {
    const QuantityPlace& at = model_->sensors()[as_size(i)];
    const double factor = 100.0 * at.sign / y(i);
    channels_.slopes(jacobian, at.place, factor, readings_.row(i));
    direct_metal_readings_.row(i) = factor * metal(as_index(at.place));
  }
  for (Eigen::Index i = 0; i < layout_.auxiliary_count; ++i) {
    const QuantityPlace& at = model_->auxiliary()[as_size(i)];
    channels_.slopes(jacobian, at.place, at.sign, outputs_.row(i));
    direct_metal_outputs_.row(i) = at.sign * metal(as_index(at.place));
  }
}

/// What the gas meets, by its temperature of the last answer.
sim::MetalTemperatures EngineTangent::effective_metal(const EngineMotion& motion) const noexcept {
  sim::MetalTemperatures metal_k = motion.metal_k;
  for (std::size_t i = 0; i < metal_k.size(); ++i) metal_k[i] -= (motion.conductance - 1.0) * soak_k_(as_index(i));
  return metal_k;
}

void EngineTangent::measure_soak(const EngineMotion& motion) noexcept {
  const auto& metal = model_->engine().data().metal;
  for (std::size_t i = 0; i < metal.size(); ++i)  // k (T - Te) is (1 + a) k D
    soak_k_(as_index(i)) =
        gas_.metal_dot_k_s[i] * metal[i].capacity_j_k / (metal[i].conductance_w_k * motion.conductance);
}

Eigen::Vector3d EngineTangent::metal_shift(CauseKind kind, const EngineMotion& motion) const noexcept {
  if (kind == CauseKind::conductance) return motion.conductance * metal_by_cause_.col(0) - soak_k_;
  return motion.conductance * metal_by_cause_.col(1);
}

void EngineTangent::advance_metal(double dt_s, EngineMotion& motion) noexcept {
  const Eigen::Vector3d rate = Eigen::Vector3d(gas_.metal_dot_k_s.data()) / motion.capacity;
  const double step_s = dt_s / motion.capacity;
  metal_by_cause_.col(0) += step_s * metal_by_metal_ * metal_shift(CauseKind::conductance, motion);
  metal_by_cause_.col(1) += step_s * (metal_by_metal_ * metal_shift(CauseKind::capacity, motion) - rate);
  for (std::size_t i = 0; i < motion.metal_k.size(); ++i) motion.metal_k[i] += dt_s * rate(as_index(i));
}

void EngineTangent::renew_soak_causes(const EngineMotion& motion) noexcept {
  for (Eigen::Index i = 0; i < layout_.cause_count; ++i) {
    const OnBoardCause& cause = model_->causes()[as_size(i)];
    if (!of_metal(cause.kind)) continue;
    const Eigen::Vector3d shift_k = cause.sigma * metal_shift(cause.kind, motion);
    const Eigen::Index column = layout_.first_cause() + i;
    rates_.col(column) = metal_rates_ * shift_k;
    readings_.col(column) = direct_metal_readings_ * shift_k;
    outputs_.col(column) = direct_metal_outputs_ * shift_k;
  }
}

void EngineTangent::renew_cause(Eigen::Index cause, const sim::Operation& operation,
                                const EngineMotion& motion) noexcept {
  const OnBoardCause& c = model_->causes()[as_size(cause)];
  if (of_metal(c.kind)) return;
  sim::Operation altered = operation;
  if (c.kind == CauseKind::input) {
    // Of what is reported the error is taken off: the truth is the other way round.
    sim::Mismatch one{};
    one[c.index] = -c.sigma;
    const sim::ReportedInputs truth = sim::misread({operation.flight, operation.fuel_flow_kg_s}, one);
    altered.flight = truth.flight;
    altered.fuel_flow_kg_s = truth.fuel_flow_kg_s;
  }
  sim::GasPath gas;
  const sim::Turbofan& engine = c.kind == CauseKind::engine ? *c.altered : model_->engine();
  if (engine_.evaluate_nearby(engine, altered, motion.speeds, gas, &gas_.metal_k) != sim::GasPathStatus::ok) return;
  const Eigen::Index column = layout_.first_cause() + cause;
  rates_.col(column) = rates_of(gas) - rates_of(gas_);
  const SensorVector y = readings_of(gas_);
  readings_.col(column) = 100.0 * (readings_of(gas) - y).cwiseQuotient(y);
  outputs_.col(column) = outputs_of(gas) - outputs_of(gas_);
}

void EngineTangent::settle() noexcept {
  const OnBoardOptions& o = model_->options();
  const auto& health = model_->definition().channels.health;
  // dN = -F_x^-1 F_xi dxi; an engine that does not return to rest has no settled answer, and its direct one stands
  Eigen::Matrix2d inverse;
  bool invertible = false;
  speed_rates().computeInverseWithCheck(inverse, invertible);
  const Eigen::Matrix2d back = invertible ? Eigen::Matrix2d(-inverse) : Eigen::Matrix2d(Eigen::Matrix2d::Zero());
  const auto variance = [&](const auto& slopes, Eigen::Index i, double share) {
    const Eigen::RowVector2d by_rates = slopes.row(i).template head<speed_count>() * back;
    double sum = 0.0;
    for (Eigen::Index j = 0; j < layout_.health_count; ++j) {
      const Eigen::Index at = UnknownLayout::first_health() + j;
      const double s = o.path_slope_error * 100.0 * health[as_size(j)].sigma *
                       (slopes(i, at) + by_rates.dot(rates_.col(at).transpose()));
      sum += s * s;
    }
    for (Eigen::Index j = 0; j < layout_.cause_count; ++j) {
      const Eigen::Index at = layout_.first_cause() + j;
      const double s = share * (slopes(i, at) + by_rates.dot(rates_.col(at).transpose()));
      sum += s * s;
    }
    return sum;
  };
  for (Eigen::Index i = 0; i < layout_.sensor_count; ++i) path_variance_(i) = variance(readings_, i, o.path_share);
  const auto by_health = [&](const auto& slopes) {
    return slopes.middleCols(UnknownLayout::first_health(), layout_.health_count);
  };
  settled_health_ = by_health(readings_) + readings_.leftCols<speed_count>() * back * by_health(rates_);
  for (Eigen::Index i = 0; i < layout_.auxiliary_count; ++i)
    path_output_variance_(i) = variance(outputs_, i, o.output_share);
  metal_readings_ = direct_metal_readings_ + readings_.leftCols<speed_count>() * back * metal_rates_;
  metal_outputs_ = direct_metal_outputs_ + outputs_.leftCols<speed_count>() * back * metal_rates_;
}

}  // namespace ehm::onboard
