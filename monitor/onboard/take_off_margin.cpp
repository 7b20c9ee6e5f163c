// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/take_off_margin.h"

#include <cmath>

#include "engine_sim/model/parts/root_theta.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;

constexpr double difference_percent = 0.5;

/// By how much more than `thrust_n` the engine gives when T48 is higher by `margin_k`, as a share, and 1/K of it there.
struct ThrustReserve {
  double share, per_k;
};
ThrustReserve thrust_reserve(const sim::Turbofan& engine, const sim::HealthVector& health, double thrust_n,
                             double margin_k) {
  constexpr double difference = 0.01;
  constexpr int steps = 3;  // a secant: T48 is nearly straight in thrust
  const double here_k = egt_margin_k(engine, health, thrust_n);
  const auto used_k = [&](double share) { return here_k - egt_margin_k(engine, health, thrust_n * (1.0 + share)); };
  const double per_k = difference / used_k(difference);
  double share = margin_k * per_k;
  for (int i = 0; i < steps && share != 0.0; ++i) share *= margin_k / used_k(share);
  return {share, per_k};
}

}  // namespace

double take_off_thrust_n(const sim::Turbofan& filed) {
  const sim::DesignPoint& design = filed.data().design;
  const auto& inlet = filed.data().inlet;
  const double n1_rpm =
      take_off_power * design.speeds.n1_rpm * sim::root_theta(inlet, hot_day) / sim::root_theta(inlet, design.flight);
  return sim::solve_steady(filed, hot_day, {}, {sim::DemandKind::n1_rpm, n1_rpm}).gas.net_thrust_n;
}

double egt_margin_k(const sim::Turbofan& engine, const sim::HealthVector& health, double net_thrust_n) {
  const sim::SteadyPoint point =
      sim::solve_steady(engine, hot_day, health, {sim::DemandKind::net_thrust_n, net_thrust_n});
  return engine.data().ratings.t48_max_k - point.gas.s48.tt_k;
}

TakeOffMargin take_off_margin(const OnBoardModel& model, const Learned& learned) {
  const UnknownLayout layout(model);
  const auto& channels = model.definition().channels.health;
  const double thrust_n = take_off_thrust_n(model.engine());
  sim::HealthVector health{};
  for (std::size_t j = 0; j < channels.size(); ++j) health[channels[j].parameter] = 0.01 * learned.value(as_index(j));
  const double at_health_k = egt_margin_k(model.engine(), health, thrust_n);
  UnknownVector slope = UnknownVector::Zero(learned.value.size());
  for (std::size_t j = 0; j < channels.size(); ++j) {
    sim::HealthVector up = health, down = health;
    up[channels[j].parameter] += 0.01 * difference_percent;
    down[channels[j].parameter] -= 0.01 * difference_percent;
    slope(as_index(j)) = (egt_margin_k(model.engine(), up, thrust_n) - egt_margin_k(model.engine(), down, thrust_n)) /
                         (2.0 * difference_percent);
  }
  double margin_k = at_health_k;
  for (std::size_t i = 0; i < model.causes().size(); ++i) {
    const OnBoardCause& cause = model.causes()[i];
    if (cause.kind != CauseKind::engine) continue;
    const Eigen::Index at = layout.health_count + as_index(i);
    slope(at) = egt_margin_k(*cause.altered, health, thrust_n) - at_health_k;
    margin_k += slope(at) * learned.value(at);
  }
  const double sigma_k = std::sqrt(slope.dot(learned.covariance * slope));
  const ThrustReserve reserve = thrust_reserve(model.engine(), health, thrust_n, margin_k);
  return {margin_k, sigma_k, reserve.share, reserve.per_k * sigma_k};
}

}  // namespace ehm::onboard
