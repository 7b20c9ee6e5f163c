// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/linearise/engine_channels.h"

#include <limits>
#include <span>
#include <string>

#include "deploy/runtime/numbers/index.h"

namespace ehm::tuner_design {

using engine_sim::OutputChannel;
using linear_model::Channel;

namespace {

/// The states are quantities of the gas path, too.
std::vector<const OutputChannel*> state_channels(const EngineLayout& layout) {
  static const std::vector<const OutputChannel*> spools{engine_sim::find_output("Nf"), engine_sim::find_output("Nc")};
  static const std::vector<const OutputChannel*> spools_and_metal{
      spools[0], spools[1], engine_sim::find_output("Tm_hpc"), engine_sim::find_output("Tm_hpt"),
      engine_sim::find_output("Tm_lpt")};
  return layout.heat_soak ? spools_and_metal : spools;
}

template <class Listed>
Channel channel_of(const Listed& channel, double trim) {
  return {std::string(channel.name), std::string(channel.unit), trim};
}

}  // namespace

std::vector<Eigen::Index> EngineLayout::settled_inputs() const {
  std::vector<Eigen::Index> at;
  for (Eigen::Index i = 1; i < states(); ++i) at.push_back(i);
  for (std::size_t i = 0; i < channels().controls.size(); ++i)
    if (channels().controls[i]->name == "fuel_flow") at.push_back(controls() + as_index(i));
  return at;
}

Eigen::VectorXd inputs_of(const EngineLayout& layout, const engine_sim::SteadyPoint& point) {
  Eigen::VectorXd v(layout.inputs());
  Eigen::Index at = 0;
  for (const OutputChannel* state : state_channels(layout))
    v(at++) = state->read(point.gas, layout.engine->data.ratings);
  engine_sim::Operation operation = point.operation;
  for (const auto* control : layout.channels().controls) v(at++) = control->of(operation);
  for (const auto& health : layout.channels().health) v(at++) = operation.health[health.parameter];
  return v;
}

Eigen::VectorXd outputs_of(const EngineLayout& layout, const engine_sim::GasPath& gas) {
  Eigen::VectorXd f(layout.outputs());
  f.head<2>() << gas.n1_dot_rpm_s, gas.n2_dot_rpm_s;
  if (layout.heat_soak) f.segment<engine_sim::metal_count>(2) = Eigen::Vector3d::Map(gas.metal_dot_k_s.data());
  Eigen::Index at = layout.sensors();
  for (const auto& sensor : layout.channels().sensors)
    f(at++) = sensor.quantity->read(gas, layout.engine->data.ratings);
  for (const OutputChannel* output : layout.channels().auxiliary)
    f(at++) = output->read(gas, layout.engine->data.ratings);
  return f;
}

Eigen::VectorXd evaluate(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                         const engine_sim::SteadyPoint& near, const Eigen::VectorXd& v) {
  engine_sim::Operation operation = near.operation;
  Eigen::Index at = layout.controls();
  for (const auto* control : layout.channels().controls) control->of(operation) = v(at++);
  for (const auto& health : layout.channels().health) operation.health[health.parameter] = v(at++);
  engine_sim::FlowUnknowns unknowns = near.unknowns;
  if (!layout.heat_soak) return outputs_of(layout, turbofan.gas_path(operation, {v(0), v(1)}, unknowns));
  const engine_sim::MetalTemperatures metal{v(2), v(3), v(4)};
  return outputs_of(layout, turbofan.gas_path(operation, {v(0), v(1)}, unknowns, &metal));
}

Eigen::VectorXd input_size(const EngineLayout& layout, const Eigen::VectorXd& v) {
  Eigen::VectorXd size = Eigen::VectorXd::Ones(layout.inputs());
  size.head(layout.states()) = v.head(layout.states());
  Eigen::Index at = layout.controls();
  for (const auto* control : layout.channels().controls) {
    size(at) = control->size > 0.0 ? control->size : v(at);
    ++at;
  }
  return size;
}

Eigen::VectorXd lowest_inputs(const EngineLayout& layout) {
  Eigen::VectorXd lowest = Eigen::VectorXd::Constant(layout.inputs(), -std::numeric_limits<double>::infinity());
  Eigen::Index at = layout.controls();
  for (const auto* control : layout.channels().controls) lowest(at++) = control->lowest;
  return lowest;
}

Plant plant_of(const EngineLayout& layout, const engine_sim::Turbofan& turbofan, const engine_sim::SteadyPoint& trim) {
  const Eigen::VectorXd v0 = inputs_of(layout, trim);
  const auto f = [layout, &turbofan, trim](const Eigen::VectorXd& v) { return evaluate(layout, turbofan, trim, v); };
  return {.states = layout.states(),
          .controls = layout.control_count(),
          .health = layout.health_count(),
          .v0 = v0,
          .f0 = f(v0),
          .size = input_size(layout, v0),
          .lowest = lowest_inputs(layout),
          .f = f};
}

void name_channels(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& f) {
  model.states.clear(), model.controls.clear(), model.health.clear(), model.sensors.clear(), model.auxiliary.clear();
  Eigen::Index in = 0, out = layout.sensors();
  for (const OutputChannel* state : state_channels(layout)) model.states.push_back(channel_of(*state, v(in++)));
  for (const auto* control : layout.channels().controls) model.controls.push_back(channel_of(*control, v(in++)));
  for (const auto& health : layout.channels().health)
    model.health.push_back({std::string(engine_sim::health_names[health.parameter]), "fraction", v(in++)});
  for (const auto& sensor : layout.channels().sensors) model.sensors.push_back(channel_of(*sensor.quantity, f(out++)));
  for (const OutputChannel* output : layout.channels().auxiliary)
    model.auxiliary.push_back(channel_of(*output, f(out++)));
}

void split_jacobian(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::MatrixXd& J) {
  const Eigen::Index n = layout.states(), u = layout.controls(), h = layout.health();
  const Eigen::Index y = layout.sensors(), z = layout.auxiliary();
  const Eigen::Index nu = layout.control_count(), p = layout.health_count();
  const Eigen::Index m = layout.sensor_count(), r = layout.auxiliary_count();
  model.A = J.block(0, 0, n, n);
  model.B = J.block(0, u, n, nu);
  model.L = J.block(0, h, n, p);
  model.C = J.block(y, 0, m, n);
  model.D = J.block(y, u, m, nu);
  model.M = J.block(y, h, m, p);
  model.F = J.block(z, 0, r, n);
  model.G = J.block(z, u, r, nu);
  model.N = J.block(z, h, r, p);
}

}  // namespace ehm::tuner_design
