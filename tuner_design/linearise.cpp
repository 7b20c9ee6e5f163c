#include "tuner_design/linearise.h"

#include <sstream>
#include <stdexcept>

#include "tuner_design/engine_channels.h"
#include "tuner_design/fleet_fit.h"

namespace ehm::bench {
namespace {

using estimation::LinearModel;

void add_noise(LinearModel& model, const NoiseAssumptions& noise) {
  model.health_sigma.setConstant(engine_health, noise.health_sigma);
  model.sensor_noise_sigma.resize(engine_sensors);
  for (Eigen::Index i = 0; i < engine_sensors; ++i) {
    const estimation::Channel& sensor = model.sensors[static_cast<std::size_t>(i)];
    const double percent = sensor.unit == "rpm"  ? noise.speed_percent
                           : sensor.unit == "Pa" ? noise.pressure_percent
                                                 : noise.temperature_percent;
    model.sensor_noise_sigma(i) = percent / 100.0 * sensor.trim;
  }
  const Eigen::Vector2d sigma(model.states[0].trim, model.states[1].trim);
  model.process_noise = (noise.process_noise_percent / 100.0 * sigma).cwiseAbs2().asDiagonal();
}

std::string model_name(const engine::FlightCondition& flight) {
  std::ostringstream name;
  name << "JT9D-class turbofan, " << flight.altitude_m << " m, Mach " << flight.mach << ", ISA "
       << (flight.delta_isa_k < 0.0 ? "" : "+") << flight.delta_isa_k << " K";
  return name.str();
}

}  // namespace

Linearisation linearise(const engine::Turbofan& turbofan, const LineariseOptions& options) {
  const engine::SteadyPoint trim = engine::solve_steady(turbofan, options.flight, options.health, options.demand);
  Linearisation result;
  LinearModel& model = result.model;
  model.name = model_name(options.flight);
  model.engine_type = "jt9d";
  model.discrete = false;
  model.sample_time_s = options.sample_time_s;
  model.operating_point = {options.flight.altitude_m, options.flight.mach, options.flight.delta_isa_k};

  Fleet fleet;
  if (options.fleet > 0) fleet = steady_fleet(turbofan, trim, options.noise.health_sigma, options.fleet, options.seed);
  if (options.method == LineariseMethod::fleet) {
    if (options.fleet == 0) throw std::invalid_argument("linearise: the method fleet needs a fleet (--fleet above 0)");
    const FleetFit fit = fit_fleet(turbofan, trim, fleet, options.seed + 1);
    name_channels(model, fit.inputs, fit.outputs);
    split_jacobian(model, fit.jacobian);
  } else {
    result.study = study_steps(turbofan, trim);
    name_channels(model, inputs_of(trim), outputs_of(trim.gas));
    split_jacobian(model, result.study.jacobian);
  }
  add_noise(model, options.noise);
  if (options.fleet > 0) model.linearisation_error = linearisation_error(model, fleet);
  return result;
}

}  // namespace ehm::bench
