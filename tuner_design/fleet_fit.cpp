#include "tuner_design/fleet_fit.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <stdexcept>
#include <string>

#include "engine_sim/sensors/noise_source.h"

namespace ehm::bench {
namespace {

constexpr Eigen::Index off_balance = engine_states + engine_controls;  ///< speeds and fuel
constexpr double disturbance = 0.003;  ///< of trim, one sigma: far above round-off, small against the fleet's spread

Eigen::VectorXd trims(const std::vector<estimation::Channel>& channels) {
  Eigen::VectorXd trim(static_cast<Eigen::Index>(channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) trim(static_cast<Eigen::Index>(i)) = channels[i].trim;
  return trim;
}

}  // namespace

Fleet steady_fleet(const engine::Turbofan& turbofan, const engine::SteadyPoint& trim, double health_sigma, int engines,
                   std::uint64_t seed) {
  engine::NoiseSource random(seed);
  Fleet fleet{Eigen::MatrixXd(engine_inputs, engines), Eigen::MatrixXd(engine_outputs, engines)};
  Eigen::Index solved = 0;
  for (int k = 0; k < engines; ++k) {
    engine::HealthVector worn = trim.operation.health;
    for (double& h : worn) h += health_sigma * random.normal();
    try {
      const engine::SteadyPoint point = engine::solve_steady(
          turbofan, trim.operation.flight, worn, {engine::DemandKind::n1_rpm, trim.gas.speeds.n1_rpm}, &trim);
      fleet.inputs.col(solved) = inputs_of(point);
      fleet.outputs.col(solved) = outputs_of(point.gas);
      ++solved;
    } catch (const engine::SolveError&) {
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

FleetFit fit_fleet(const engine::Turbofan& turbofan, const engine::SteadyPoint& trim, const Fleet& fleet,
                   std::uint64_t seed) {
  const Eigen::VectorXd v0 = inputs_of(trim), f0 = outputs_of(trim.gas);
  Eigen::VectorXd scale = Eigen::VectorXd::Constant(engine_inputs, 0.01);  // one percent
  scale.head(off_balance) *= v0.head(off_balance).asDiagonal();
  engine::NoiseSource random(seed);
  const Eigen::Index engines = fleet.inputs.cols();
  Eigen::MatrixXd regressors(engines, 1 + engine_inputs), deviations(engines, engine_outputs);
  for (Eigen::Index k = 0; k < engines; ++k) {
    Eigen::VectorXd v = fleet.inputs.col(k);
    for (Eigen::Index j = 0; j < off_balance; ++j) v(j) += disturbance * v0(j) * random.normal();
    regressors.row(k) << 1.0, (v - v0).cwiseQuotient(scale).transpose();
    deviations.row(k) = (evaluate(turbofan, trim, v) - f0).transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(regressors);
  if (qr.rank() < regressors.cols())
    throw std::runtime_error("linearise: " + std::to_string(engines) + " engines do not tell the " +
                             std::to_string(engine_inputs) + " inputs apart; take a larger fleet (--fleet)");
  const Eigen::MatrixXd solution = qr.solve(deviations).transpose();  // [intercept | J scale]

  FleetFit fit;
  fit.jacobian = solution.rightCols(engine_inputs) * scale.cwiseInverse().asDiagonal();
  const Eigen::VectorXd intercept = solution.col(0);
  // Balance of the fitted engine at the trim's fan speed: core speed and fuel take up the rates of the intercept.
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(engine_inputs);
  shift.segment(1, 2) = -fit.jacobian.block(0, 1, engine_rates, 2).partialPivLu().solve(intercept.head(engine_rates));
  fit.inputs = v0 + shift;
  fit.outputs = f0 + intercept + fit.jacobian * shift;
  return fit;
}

Eigen::MatrixXd linearisation_error(const estimation::LinearModel& model, const Fleet& fleet) {
  Eigen::VectorXd trim(engine_sensors + engine_auxiliary);
  trim << trims(model.sensors), trims(model.auxiliary);
  const auto balance = model.A.partialPivLu();
  Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(trim.size(), trim.size());
  for (Eigen::Index k = 0; k < fleet.inputs.cols(); ++k) {
    const Eigen::VectorXd u = fleet.inputs.col(k).segment(engine_states, engine_controls) - trims(model.controls);
    const Eigen::VectorXd h = fleet.inputs.col(k).tail(engine_health) - trims(model.health);
    const Eigen::VectorXd x = -balance.solve(model.B * u + model.L * h);
    Eigen::VectorXd linear(trim.size());
    linear << model.C * x + model.D * u + model.M * h, model.F * x + model.G * u + model.N * h;
    const Eigen::VectorXd missed = fleet.outputs.col(k).tail(trim.size()) - trim - linear;
    moment += missed * missed.transpose();
  }
  return moment / static_cast<double>(fleet.inputs.cols());
}

}  // namespace ehm::bench
