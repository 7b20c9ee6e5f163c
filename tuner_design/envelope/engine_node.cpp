// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/envelope/engine_node.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/numbers/noise_source.h"
#include "deploy/runtime/units/units.h"
#include "engine_sim/control/scheduled_point.h"
#include "engine_sim/model/solve/newton.h"
#include "engine_sim/model/thermo/ram.h"
#include "tuner_design/linearise/fleet_fit.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;
using schedule::Node;
using schedule::Similarity;

double factor(const Similarity& s, const sim::RamRatios& ram) {
  return std::pow(ram.delta, s.delta_power) * std::pow(ram.theta, s.theta_power);
}

Eigen::VectorXd factors(const std::vector<Similarity>& channels, const sim::RamRatios& ram) {
  Eigen::VectorXd f(as_index(channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) f(as_index(i)) = factor(channels[i], ram);
  return f;
}

/// From readings at theta and delta to those at sea level.
void reduce(Node& node, const schedule::Schedule& s, const sim::RamRatios& ram) {
  const Eigen::VectorXd x = factors(s.states, ram), u = factors(s.actuators, ram), y = factors(s.sensors, ram),
                        z = factors(s.auxiliary, ram);
  const double pace = ram.delta / std::sqrt(ram.theta);
  const Eigen::VectorXd rate = pace * x;
  const auto over = [](const Eigen::VectorXd& v) { return v.cwiseInverse().asDiagonal().toDenseMatrix(); };
  node.x0 = over(x) * node.x0, node.u0 = over(u) * node.u0, node.y0 = over(y) * node.y0, node.z0 = over(z) * node.z0;
  node.A = (over(rate) * node.A * x.asDiagonal()).eval();
  node.B = (over(rate) * node.B * u.asDiagonal()).eval();
  node.L = over(rate) * node.L;
  node.C = (over(y) * node.C * x.asDiagonal()).eval();
  node.D = (over(y) * node.D * u.asDiagonal()).eval();
  node.M = over(y) * node.M;
  node.F = (over(z) * node.F * x.asDiagonal()).eval();
  node.G = (over(z) * node.G * u.asDiagonal()).eval();
  node.N = over(z) * node.N;
  node.lambda_x = over(rate) * node.lambda_x, node.lambda_y = over(y) * node.lambda_y;
  node.lambda_z = over(z) * node.lambda_z;
}

sim::RamRatios ratios(const sim::FlightCondition& flight) {
  return sim::ram_ratios(flight.altitude_m, flight.mach, flight.delta_isa_k);
}

std::optional<sim::SteadyPoint> steady_point(const sim::EngineDefinition& engine, const sim::Turbofan& turbofan,
                                             const NodePlace& place, const sim::FlightCondition& flight) {
  const double n1_rpm = place.n1_corrected_rpm * std::sqrt(ratios(flight).theta);
  try {
    return sim::solve_scheduled(turbofan, engine.control, {flight, {}, {}}, {sim::DemandKind::n1_rpm, n1_rpm});
  } catch (const sim::SolveError&) {
    return std::nullopt;
  }
}

/// Engines of the fleet at the trim's fan speed, with its vanes and valves.
Fleet fleet_around(const EngineLayout& layout, const sim::Turbofan& turbofan, const sim::SteadyPoint& trim,
                   const NodeOptions& options) {
  NoiseSource random(options.seed);
  Fleet fleet{layout, Eigen::MatrixXd(layout.inputs(), options.fleet),
              Eigen::MatrixXd(layout.outputs(), options.fleet)};
  Eigen::Index solved = 0;
  for (int k = 0; k < options.fleet; ++k) {
    sim::Operation worn = trim.operation;
    for (const auto& health : layout.channels().health) worn.health[health.parameter] += health.sigma * random.normal();
    try {
      const sim::SteadyPoint point =
          sim::solve_steady(turbofan, worn, {sim::DemandKind::n1_rpm, trim.gas.speeds.n1_rpm}, &trim);
      fleet.inputs.col(solved) = inputs_of(layout, point);
      fleet.outputs.col(solved) = outputs_of(layout, point.gas);
      ++solved;
    } catch (const sim::SolveError&) {
      // left out; too many of them, and the node is none
    }
  }
  fleet.inputs.conservativeResize(Eigen::NoChange, solved);
  fleet.outputs.conservativeResize(Eigen::NoChange, solved);
  return fleet;
}

void take_derivatives(const EngineLayout& l, const Eigen::MatrixXd& j, Node& node) {
  constexpr double percent = 0.01;  // health counts in percent
  const auto block = [&](Eigen::Index row, Eigen::Index rows, Eigen::Index column, Eigen::Index columns) {
    return Eigen::MatrixXd(j.block(row, column, rows, columns));
  };
  const Eigen::Index n = l.states(), u = l.control_count(), h = l.health_count(), m = l.sensor_count(),
                     r = l.auxiliary_count();
  node.A = block(0, n, 0, n), node.B = block(0, n, l.controls(), u), node.L = percent * block(0, n, l.health(), h);
  node.C = block(l.sensors(), m, 0, n), node.D = block(l.sensors(), m, l.controls(), u);
  node.M = percent * block(l.sensors(), m, l.health(), h);
  node.F = block(l.auxiliary(), r, 0, n), node.G = block(l.auxiliary(), r, l.controls(), u);
  node.N = percent * block(l.auxiliary(), r, l.health(), h);
}

void take_trim(const EngineLayout& l, const Eigen::VectorXd& v, const Eigen::VectorXd& f, Node& node) {
  node.x0 = v.head(l.states()), node.u0 = v.segment(l.controls(), l.control_count());
  node.y0 = f.segment(l.sensors(), l.sensor_count()), node.z0 = f.segment(l.auxiliary(), l.auxiliary_count());
}

}  // namespace

sim::FlightCondition flight_at(double mach, double t2_k) {
  constexpr double sea_level_k = 288.15, lapse_k_m = 0.0065, tropopause_m = 11000.0;
  const double t0_k = t2_k / (1.0 + 0.2 * mach * mach);
  const double altitude_m = std::clamp((sea_level_k - t0_k) / lapse_k_m, 0.0, tropopause_m);
  return {altitude_m, mach, t0_k - (sea_level_k - lapse_k_m * altitude_m)};
}

Similarity similarity_of(const std::string& name, const std::string& unit) {
  // A scale with an offset is none that a ratio means anything on.
  const auto is = [&](const char* si) {
    const auto conversion = units::conversion(unit, si);
    return !unit.empty() && conversion && conversion->offset == 0.0;
  };
  if (is("rpm")) return {0.0, 0.5};
  if (is("K")) return {0.0, 1.0};
  if (is("Pa") || is("N")) return {1.0, 0.0};
  if (is("W")) return {1.0, 0.5};
  const bool fuel = name.find("fuel") != std::string::npos || name == "Wf";
  if (is("kg/s")) return {1.0, fuel ? 0.5 : -0.5};
  return {};
}

Eigen::VectorXd engine_trim(const std::shared_ptr<const sim::EngineDefinition>& engine, const sim::Turbofan& turbofan,
                            const NodePlace& place, const schedule::Schedule& schedule) {
  const sim::FlightCondition flight = flight_at(place.mach, place.t2_k);
  const auto trim = steady_point(*engine, turbofan, place, flight);
  if (!trim) return {};
  const EngineLayout layout{engine, false};
  Node node;
  take_trim(layout, inputs_of(layout, *trim), outputs_of(layout, trim->gas), node);
  take_derivatives(layout, Eigen::MatrixXd::Zero(layout.outputs(), layout.inputs()), node);
  node.lambda_x.setZero(layout.states()), node.lambda_y.setZero(layout.sensor_count());
  node.lambda_z.setZero(layout.auxiliary_count());
  reduce(node, schedule, ratios(flight));
  Eigen::VectorXd all(node.x0.size() + node.u0.size() + node.y0.size() + node.z0.size());
  all << node.x0, node.u0, node.y0, node.z0;
  return all;
}

Node engine_node(const std::shared_ptr<const sim::EngineDefinition>& engine, const sim::Turbofan& turbofan,
                 const NodePlace& place, const schedule::Schedule& schedule, const NodeOptions& options) {
  const sim::FlightCondition flight = flight_at(place.mach, place.t2_k);
  const auto trim = steady_point(*engine, turbofan, place, flight);
  Node node;
  if (!trim) return node;
  const EngineLayout layout{engine, false};
  const Fleet fleet = fleet_around(layout, turbofan, *trim, options);
  if (10 * (options.fleet - fleet.inputs.cols()) > options.fleet) return node;
  try {
    const FleetFit fit = fit_fleet(turbofan, *trim, fleet);
    take_trim(layout, fit.inputs, fit.outputs, node);
    take_derivatives(layout, fit.jacobian, node);
    const Eigen::MatrixXd missed =
        (fleet.outputs.colwise() - fit.outputs) - fit.jacobian * (fleet.inputs.colwise() - fit.inputs);
    const Eigen::VectorXd lambda = missed.cwiseAbs2().rowwise().mean().cwiseSqrt();
    node.lambda_x = lambda.head(layout.states());
    node.lambda_y = lambda.segment(layout.sensors(), layout.sensor_count());
    node.lambda_z = lambda.segment(layout.auxiliary(), layout.auxiliary_count());
  } catch (const sim::SolveError&) {
    return {};
  }
  node.valid = true;
  reduce(node, schedule, ratios(flight));
  return node;
}

}  // namespace ehm::tuner_design
