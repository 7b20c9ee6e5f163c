// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/linearise.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "tuner_design/linearise/engine_channels.h"
#include "tuner_design/linearise/fleet_fit.h"

namespace ehm::tuner_design {
namespace {

using linear_model::LinearModel;

void add_noise(const std::vector<engine_sim::SensorChannel>& sensors, const engine_sim::NamedChannels& channels,
               double process_noise_percent, LinearModel& model) {
  const auto m = as_index(sensors.size());
  model.health_sigma.resize(as_index(channels.health.size()));
  for (std::size_t i = 0; i < channels.health.size(); ++i) model.health_sigma(as_index(i)) = channels.health[i].sigma;
  Eigen::VectorXd resolution(m);
  for (Eigen::Index i = 0; i < m; ++i) resolution(i) = sensors[as_size(i)].resolution;
  if (!resolution.isZero(0.0)) model.sensor_resolution = resolution;
  model.sensor_noise_sigma.resize(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto at = as_size(i);
    const double own_sigma = sensors[at].noise_percent / 100.0 * std::abs(model.sensors[at].trim);
    model.sensor_noise_sigma(i) = linear_model::counted_sigma(model, i, own_sigma);
  }
  // the metal follows the gas without noise of its own
  Eigen::VectorXd sigma = Eigen::VectorXd::Zero(as_index(model.states.size()));
  sigma.head<2>() << model.states[0].trim, model.states[1].trim;
  model.process_noise = (process_noise_percent / 100.0 * sigma).cwiseAbs2().asDiagonal();
}

/// One more state for each lagging sensor: s' = (C x + D u + M h - s)/tau.
void add_sensor_lags(const std::vector<engine_sim::SensorChannel>& sensors, LinearModel& model) {
  for (Eigen::Index i = 0; i < as_index(sensors.size()); ++i) {
    const linear_model::Channel& sensor = model.sensors[as_size(i)];
    const double tau_s = sensors[as_size(i)].lag_s;
    if (tau_s == 0.0) continue;
    const Eigen::Index n = model.A.rows();
    const auto grow = [](Eigen::MatrixXd& m, Eigen::Index rows, Eigen::Index columns) {
      m.conservativeResizeLike(Eigen::MatrixXd::Zero(m.rows() + rows, m.cols() + columns));
    };
    grow(model.A, 1, 1);
    grow(model.B, 1, 0);
    grow(model.L, 1, 0);
    grow(model.C, 0, 1);
    grow(model.F, 0, 1);
    grow(model.process_noise, 1, 1);
    model.A.row(n) = model.C.row(i) / tau_s;
    model.A(n, n) = -1.0 / tau_s;
    model.B.row(n) = model.D.row(i) / tau_s;
    model.L.row(n) = model.M.row(i) / tau_s;
    model.C.row(i).setZero();
    model.C(i, n) = 1.0;
    model.D.row(i).setZero();
    model.M.row(i).setZero();
    model.states.push_back({sensor.name + "_sensor", sensor.unit, sensor.trim});
  }
}

/// Which engine, and where it runs: points of one envelope differ by it.
std::string model_name(const engine_sim::EngineData& engine, const engine_sim::SteadyPoint& trim) {
  const engine_sim::FlightCondition& flight = trim.operation.flight;
  std::ostringstream name;
  name << engine.name << (engine.name.ends_with("turbofan") ? ", " : "-class turbofan, ") << flight.altitude_m
       << " m, Mach " << flight.mach << ", ISA " << std::showpos << flight.delta_isa_k << std::noshowpos << " K, T40 "
       << std::round(trim.gas.s40.tt_k) << " K";
  return name.str();
}

/// df/dv, block by block. `study` is filled if a block is the tangent's.
Eigen::MatrixXd jacobian_by_blocks(const Plant& plant, const BlockMethods& methods, StepStudy& study) {
  if (!methods.states || !methods.controls || !methods.health) study = study_steps(plant);
  const auto tangent = [&](Eigen::Index first, Eigen::Index count) -> Eigen::MatrixXd {
    return study.jacobian.middleCols(first, count);
  };
  const Eigen::MatrixXd states =
      methods.states ? state_columns(plant, *methods.states, methods.steps) : tangent(0, plant.states);
  Eigen::MatrixXd jacobian(plant.outputs(), plant.inputs());
  jacobian << states,
      methods.controls ? control_columns(plant, *methods.controls, methods.steps, states)
                       : tangent(plant.first_control(), plant.controls),
      methods.health ? health_columns(plant, *methods.health, methods.steps, states)
                     : tangent(plant.first_health(), plant.health);
  return jacobian;
}

}  // namespace

Linearisation linearise(std::shared_ptr<const engine_sim::EngineDefinition> engine, const LineariseOptions& options) {
  const engine_sim::Turbofan turbofan(engine->data);
  const engine_sim::SteadyPoint trim =
      engine_sim::solve_steady(turbofan, options.flight, options.health, options.demand);
  Linearisation result;
  LinearModel& model = result.model;
  model.name = model_name(turbofan.data(), trim);
  model.engine_type = engine_sim::engine_type(engine->data);
  model.engine_hash = engine_sim::engine_hash(*engine);
  model.discrete = false;
  model.sample_time_s = options.sample_time_s;
  model.operating_point = {options.flight.altitude_m, options.flight.mach, options.flight.delta_isa_k};

  const EngineLayout layout{engine, options.heat_soak};
  Fleet fleet;
  if (options.fleet > 0) fleet = steady_fleet(layout, turbofan, trim, options.fleet, options.seed);
  if (options.method == LineariseMethod::fleet) {
    if (options.blocks.any())
      throw std::invalid_argument("linearise: the method fleet fits all columns at once; no block has its own method");
    if (options.fleet == 0) throw std::invalid_argument("linearise: the method fleet needs a fleet (--fleet above 0)");
    const FleetFit fit = fit_fleet(turbofan, trim, fleet);
    name_channels(layout, model, fit.inputs, fit.outputs);
    split_jacobian(layout, model, fit.jacobian);
  } else {
    name_channels(layout, model, inputs_of(layout, trim), outputs_of(layout, trim.gas));
    split_jacobian(layout, model, jacobian_by_blocks(plant_of(layout, turbofan, trim), options.blocks, result.study));
  }
  const auto sensors = engine_sim::overridden(engine->channels.sensors, options.sensors);
  add_noise(sensors, engine->channels, options.process_noise_percent, model);
  if (options.fleet > 0) model.linearisation_error = linearisation_error(model, fleet);
  add_sensor_lags(sensors, model);  // in steady state they change nothing
  return result;
}

}  // namespace ehm::tuner_design
