// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/fleet_fit.h"

#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/noise_source.h"

namespace ehm::tuner_design {
namespace {

constexpr double disturbance = 0.003;  ///< of size: far above round-off, small against the fleet's spread

/// Derivatives by states and controls, averaged over the fleet: central differences, one-sided where an input cannot be
/// less: bleed valves only open.
Eigen::MatrixXd mean_slopes(const engine_sim::Turbofan& turbofan, const engine_sim::SteadyPoint& trim,
                            const Fleet& fleet, const Eigen::VectorXd& size) {
  const EngineLayout& layout = fleet.layout;
  const Eigen::VectorXd lowest = lowest_inputs(layout);
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(layout.outputs(), layout.health());
  for (Eigen::Index k = 0; k < fleet.inputs.cols(); ++k) {
    for (Eigen::Index j = 0; j < slopes.cols(); ++j) {
      Eigen::VectorXd up = fleet.inputs.col(k), down = up;
      up(j) += disturbance * size(j);
      if (down(j) - disturbance * size(j) >= lowest(j)) down(j) -= disturbance * size(j);
      slopes.col(j) +=
          (evaluate(layout, turbofan, trim, up) - evaluate(layout, turbofan, trim, down)) / (up(j) - down(j));
    }
  }
  return slopes / static_cast<double>(fleet.inputs.cols());
}

}  // namespace

Fleet steady_fleet(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                   const engine_sim::SteadyPoint& trim, int engines, std::uint64_t seed) {
  NoiseSource random(seed);
  Fleet fleet{layout, Eigen::MatrixXd(layout.inputs(), engines), Eigen::MatrixXd(layout.outputs(), engines)};
  Eigen::Index solved = 0;
  for (int k = 0; k < engines; ++k) {
    engine_sim::HealthVector worn = trim.operation.health;
    for (const auto& health : layout.channels().health) worn[health.parameter] += health.sigma * random.normal();
    try {
      const engine_sim::SteadyPoint point = engine_sim::solve_steady(
          turbofan, trim.operation.flight, worn, {engine_sim::DemandKind::n1_rpm, trim.gas.speeds.n1_rpm}, &trim);
      fleet.inputs.col(solved) = inputs_of(layout, point);
      fleet.outputs.col(solved) = outputs_of(layout, point.gas);
      ++solved;
    } catch (const engine_sim::SolveError&) {
      // counted below
    }
  }
  if (100 * (engines - solved) > engines)
    throw std::runtime_error("linearise: " + std::to_string(engines - solved) + " of " + std::to_string(engines) +
                             " engines of the fleet have no steady point at the trim's fan speed");
  fleet.inputs.conservativeResize(Eigen::NoChange, solved);
  fleet.outputs.conservativeResize(Eigen::NoChange, solved);
  return fleet;
}

FleetFit fit_fleet(const engine_sim::Turbofan& turbofan, const engine_sim::SteadyPoint& trim, const Fleet& fleet) {
  const EngineLayout& layout = fleet.layout;
  const Eigen::VectorXd v0 = inputs_of(layout, trim), f0 = outputs_of(layout, trim.gas);
  const Eigen::MatrixXd slopes = mean_slopes(turbofan, trim, fleet, input_size(layout, v0));
  const Eigen::Index engines = fleet.inputs.cols(), moved = slopes.cols(), healths = layout.health_count();
  Eigen::MatrixXd regressors(engines, 1 + healths), left(engines, layout.outputs());
  for (Eigen::Index k = 0; k < engines; ++k) {
    const Eigen::VectorXd dv = fleet.inputs.col(k) - v0;
    regressors.row(k) << 1.0, dv.tail(healths).transpose();
    left.row(k) = (fleet.outputs.col(k) - f0 - slopes * dv.head(moved)).transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(regressors);
  if (qr.rank() < regressors.cols())
    throw std::runtime_error("linearise: " + std::to_string(engines) + " engines do not tell the " +
                             std::to_string(healths) + " health parameters apart; take a larger fleet (--fleet)");
  const Eigen::MatrixXd solution = qr.solve(left).transpose();  // [intercept | health columns]

  FleetFit fit;
  fit.jacobian.resize(layout.outputs(), layout.inputs());
  fit.jacobian << slopes, solution.rightCols(healths);
  const Eigen::VectorXd intercept = solution.col(0);
  // Balance of the fitted engine at the trim's fan speed: the other states and the fuel flow take up the rates of the
  // intercept.
  const Eigen::Index n = layout.states();
  const std::vector<Eigen::Index> settled = layout.settled_inputs();
  const Eigen::MatrixXd balance = fit.jacobian.topRows(n)(Eigen::all, settled);
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(layout.inputs());
  shift(settled) = -balance.partialPivLu().solve(intercept.head(n));
  fit.inputs = v0 + shift;
  fit.outputs = f0 + intercept + fit.jacobian * shift;
  return fit;
}

Eigen::MatrixXd linearisation_error(const linear_model::LinearModel& model, const Fleet& fleet) {
  const EngineLayout& layout = fleet.layout;
  Eigen::VectorXd trim(layout.sensor_count() + layout.auxiliary_count());
  trim << linear_model::trims(model.sensors), linear_model::trims(model.auxiliary);
  const auto balance = model.A.partialPivLu();
  Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(trim.size(), trim.size());
  for (Eigen::Index k = 0; k < fleet.inputs.cols(); ++k) {
    const Eigen::VectorXd u =
        fleet.inputs.col(k).segment(layout.controls(), layout.control_count()) - linear_model::trims(model.controls);
    const Eigen::VectorXd h = fleet.inputs.col(k).tail(layout.health_count()) - linear_model::trims(model.health);
    const Eigen::VectorXd x = -balance.solve(model.B * u + model.L * h);
    Eigen::VectorXd linear(trim.size());
    linear << model.C * x + model.D * u + model.M * h, model.F * x + model.G * u + model.N * h;
    const Eigen::VectorXd missed = fleet.outputs.col(k).tail(trim.size()) - trim - linear;
    moment += missed * missed.transpose();
  }
  return moment / static_cast<double>(fleet.inputs.cols());
}

}  // namespace ehm::tuner_design
