#include "tuner_design/linearise.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>

#include "engine_sim/sensors/noise_source.h"

namespace ehm::bench {
namespace {

using engine::GasPath;
using engine::Operation;
using engine::SpoolSpeeds;
using engine::SteadyPoint;
using estimation::Channel;
using estimation::LinearModel;

constexpr Eigen::Index states = 2, controls = 1, health = engine::health_count, inputs = states + controls + health;
constexpr Eigen::Index sensors = 7, auxiliary = 4, rates = states, outputs = rates + sensors + auxiliary;
constexpr double allowed_change = 1e-3;

/// f = [n1_dot n2_dot | sensors | auxiliary].
Eigen::VectorXd outputs_of(const GasPath& gas) {
  Eigen::VectorXd f(outputs);
  f << gas.n1_dot_rpm_s, gas.n2_dot_rpm_s,  // rates
      gas.speeds.n1_rpm, gas.speeds.n2_rpm, gas.s24.pt_pa, gas.s24.tt_k, gas.ps_30_pa, gas.s30.tt_k, gas.s48.tt_k,
      gas.s40.tt_k, gas.s50.tt_k, gas.net_thrust_n, gas.stall_margin_lpc_percent;  // auxiliary
  return f;
}

/// f at the trim point moved by `delta` in v = [N1 N2 | Wf | health].
Eigen::VectorXd moved(const engine::Turbofan& turbofan, const SteadyPoint& trim, const Eigen::VectorXd& delta) {
  SpoolSpeeds speeds = trim.gas.speeds;
  speeds.n1_rpm += delta(0);
  speeds.n2_rpm += delta(1);
  Operation operation = trim.operation;
  operation.fuel_flow_kg_s += delta(2);
  for (std::size_t i = 0; i < engine::health_count; ++i) {
    operation.health[i] += delta(states + controls + static_cast<Eigen::Index>(i));
  }
  auto unknowns = trim.unknowns;
  return outputs_of(turbofan.gas_path(operation, speeds, unknowns));
}

/// Size of each input for a relative step: its trim, and 1 for a health fraction.
Eigen::VectorXd input_scale(const SteadyPoint& trim) {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(inputs);
  scale(0) = trim.gas.speeds.n1_rpm;
  scale(1) = trim.gas.speeds.n2_rpm;
  scale(2) = trim.operation.fuel_flow_kg_s;
  return scale;
}

/// Size of each output: its trim; a rate is measured against the speed's trim per second.
Eigen::VectorXd output_scale(const Eigen::VectorXd& trim_outputs) {
  Eigen::VectorXd scale = trim_outputs.cwiseAbs();
  scale.head(rates) = scale.segment(rates, states);
  return scale;
}

/// Central differences, outputs x inputs: df/dv = (f(v + s) - f(v - s)) / 2 s.
Eigen::MatrixXd jacobian(const engine::Turbofan& turbofan, const SteadyPoint& trim, double step) {
  const Eigen::VectorXd scale = input_scale(trim);
  Eigen::MatrixXd result(outputs, inputs);
  for (Eigen::Index j = 0; j < inputs; ++j) {
    const Eigen::VectorXd delta = step * scale(j) * Eigen::VectorXd::Unit(inputs, j);
    result.col(j) = (moved(turbofan, trim, delta) - moved(turbofan, trim, -delta)) / (2.0 * step * scale(j));
  }
  return result;
}

/// Largest relative change of a column between two scaled Jacobians.
double largest_change(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, const Eigen::VectorXd& output_size) {
  double largest = 0.0;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    const Eigen::VectorXd difference = (a.col(j) - b.col(j)).cwiseQuotient(output_size);
    largest = std::max(largest, difference.norm() / b.col(j).cwiseQuotient(output_size).norm());
  }
  return largest;
}

struct Study {
  Eigen::MatrixXd jacobian;
  double step = 0.0;
  std::vector<StepStudyRow> rows;
};

/// Steps from 1e-2 to 1e-7.5 by half decades; the step with the least change to the next smaller one wins.
Study study_steps(const engine::Turbofan& turbofan, const SteadyPoint& trim, const Eigen::VectorXd& output_size) {
  Study study;
  Eigen::MatrixXd larger = jacobian(turbofan, trim, std::pow(10.0, -2.0));
  double least = std::numeric_limits<double>::infinity();
  for (int half_decade = 4; half_decade <= 15; ++half_decade) {
    const double step = std::pow(10.0, -0.5 * half_decade);
    const Eigen::MatrixXd smaller = jacobian(turbofan, trim, std::pow(10.0, -0.5 * (half_decade + 1)));
    const double change = largest_change(larger, smaller, output_size);
    study.rows.push_back({step, change});
    if (change < least) {
      least = change;
      study.step = step;
      study.jacobian = larger;
    }
    larger = smaller;
  }
  if (!(least <= allowed_change)) {
    std::ostringstream message;
    message << "linearise: no step gives settled derivatives; the least relative change between neighbours is " << least
            << ", allowed " << allowed_change << "; the operating point may lie on a limit (choking, map edge)";
    throw std::runtime_error(message.str());
  }
  return study;
}

void name_channels(LinearModel& model, const SteadyPoint& trim, const Eigen::VectorXd& f) {
  model.states = {{"Nf", "rpm", f(2)}, {"Nc", "rpm", f(3)}};
  model.controls = {{"fuel_flow", "kg/s", trim.operation.fuel_flow_kg_s}};
  for (std::size_t i = 0; i < engine::health_count; ++i) {
    model.health.push_back({std::string(engine::health_names[i]), "fraction", trim.operation.health[i]});
  }
  const std::vector<Channel> outputs_in_order{{"Nf", "rpm", f(2)}, {"Nc", "rpm", f(3)},        {"P24", "Pa", f(4)},
                                              {"T24", "K", f(5)},  {"Ps30", "Pa", f(6)},       {"T30", "K", f(7)},
                                              {"T48", "K", f(8)},  {"T40", "K", f(9)},         {"T50", "K", f(10)},
                                              {"Fn", "N", f(11)},  {"SmLPC", "percent", f(12)}};
  model.sensors.assign(outputs_in_order.begin(), outputs_in_order.begin() + sensors);
  model.auxiliary.assign(outputs_in_order.begin() + sensors, outputs_in_order.end());
}

void add_noise(LinearModel& model, const NoiseAssumptions& noise) {
  model.health_sigma.setConstant(health, noise.health_sigma);
  model.sensor_noise_sigma.resize(sensors);
  for (Eigen::Index i = 0; i < sensors; ++i) {
    const Channel& sensor = model.sensors[static_cast<std::size_t>(i)];
    const double percent = sensor.unit == "rpm"  ? noise.speed_percent
                           : sensor.unit == "Pa" ? noise.pressure_percent
                                                 : noise.temperature_percent;
    model.sensor_noise_sigma(i) = percent / 100.0 * sensor.trim;
  }
  Eigen::VectorXd sigma(states);
  sigma << model.states[0].trim, model.states[1].trim;
  model.process_noise = (noise.process_noise_percent / 100.0 * sigma).cwiseAbs2().asDiagonal();
}

std::string model_name(const engine::FlightCondition& flight) {
  std::ostringstream name;
  name << "JT9D-class turbofan, " << flight.altitude_m << " m, Mach " << flight.mach << ", ISA "
       << (flight.delta_isa_k < 0.0 ? "" : "+") << flight.delta_isa_k << " K";
  return name.str();
}

/// [y; z] of the linear engine in steady state under the actuator deviation du and health h.
Eigen::VectorXd linear_steady(const LinearModel& model, double du, const Eigen::VectorXd& h) {
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(controls, du);
  const Eigen::VectorXd x = -model.A.partialPivLu().solve(model.B * u + model.L * h);
  Eigen::VectorXd yz(sensors + auxiliary);
  yz << model.C * x + model.D * u + model.M * h, model.F * x + model.G * u + model.N * h;
  return yz;
}

/// Second moment over the fleet of what the nonlinear engine's [y; z] adds to the linear one's.
Eigen::MatrixXd linearisation_error(const engine::Turbofan& turbofan, const SteadyPoint& trim, const LinearModel& model,
                                    const Eigen::VectorXd& trim_yz, const LineariseOptions& options) {
  engine::NoiseSource random(options.seed);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(sensors + auxiliary, sensors + auxiliary);
  int failed = 0;
  for (int k = 0; k < options.fleet; ++k) {
    Eigen::VectorXd h(health);
    for (Eigen::Index i = 0; i < health; ++i) h(i) = model.health_sigma(i) * random.normal();
    engine::HealthVector worn = trim.operation.health;
    for (std::size_t i = 0; i < worn.size(); ++i) worn[i] += h(static_cast<Eigen::Index>(i));
    try {
      const SteadyPoint point = engine::solve_steady(turbofan, options.flight, worn,
                                                     {engine::DemandKind::n1_rpm, trim.gas.speeds.n1_rpm}, &trim);
      const double du = point.operation.fuel_flow_kg_s - trim.operation.fuel_flow_kg_s;
      const Eigen::VectorXd residual =
          outputs_of(point.gas).tail(sensors + auxiliary) - trim_yz - linear_steady(model, du, h);
      sum += residual * residual.transpose();
    } catch (const engine::SolveError&) {
      ++failed;
    }
  }
  if (100 * failed > options.fleet)
    throw std::runtime_error("linearise: " + std::to_string(failed) + " of " + std::to_string(options.fleet) +
                             " engines of the fleet have no steady point at the trim's fan speed");
  return sum / (options.fleet - failed);
}

}  // namespace

Linearisation linearise(const engine::Turbofan& turbofan, const LineariseOptions& options) {
  const SteadyPoint trim = engine::solve_steady(turbofan, options.flight, options.health, options.demand);
  const Eigen::VectorXd f = outputs_of(trim.gas);
  const Study study = study_steps(turbofan, trim, output_scale(f));

  Linearisation result;
  result.step = study.step;
  result.study = study.rows;
  LinearModel& model = result.model;
  model.name = model_name(options.flight);
  model.engine_type = "jt9d";
  model.discrete = false;
  model.sample_time_s = options.sample_time_s;
  model.operating_point = {options.flight.altitude_m, options.flight.mach, options.flight.delta_isa_k};
  name_channels(model, trim, f);
  add_noise(model, options.noise);
  const Eigen::MatrixXd& J = study.jacobian;
  model.A = J.block(0, 0, rates, states);
  model.B = J.block(0, states, rates, controls);
  model.L = J.block(0, states + controls, rates, health);
  model.C = J.block(rates, 0, sensors, states);
  model.D = J.block(rates, states, sensors, controls);
  model.M = J.block(rates, states + controls, sensors, health);
  model.F = J.block(rates + sensors, 0, auxiliary, states);
  model.G = J.block(rates + sensors, states, auxiliary, controls);
  model.N = J.block(rates + sensors, states + controls, auxiliary, health);
  if (options.fleet > 0)
    model.linearisation_error = linearisation_error(turbofan, trim, model, f.tail(sensors + auxiliary), options);
  return result;
}

}  // namespace ehm::bench
