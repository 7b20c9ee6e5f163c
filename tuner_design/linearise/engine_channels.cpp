#include "tuner_design/linearise/engine_channels.h"

namespace ehm::tuner_design {

using linear_model::Channel;

namespace {

engine_sim::MetalTemperatures gas_temperatures(const engine_sim::GasPath& gas) {
  return {gas.s30.tt_k, gas.s48.tt_k, gas.s50.tt_k};
}

constexpr const char* metal_names[engine_sim::metal_count]{"Tm_hpc", "Tm_hpt", "Tm_lpt"};

}  // namespace

Eigen::VectorXd inputs_of(const EngineLayout& layout, const engine_sim::SteadyPoint& point) {
  Eigen::VectorXd v(layout.inputs());
  v(0) = point.gas.speeds.n1_rpm;
  v(1) = point.gas.speeds.n2_rpm;
  if (layout.heat_soak)
    v.segment<engine_sim::metal_count>(2) = Eigen::Vector3d::Map(gas_temperatures(point.gas).data());
  v(layout.fuel()) = point.operation.fuel_flow_kg_s;
  v(layout.fuel() + 1) = point.operation.geometry.vsv_deg;
  v(layout.fuel() + 2) = point.operation.geometry.vbv_fraction;
  for (std::size_t i = 0; i < engine_sim::health_count; ++i)
    v(layout.health() + static_cast<Eigen::Index>(i)) = point.operation.health[i];
  return v;
}

Eigen::VectorXd outputs_of(const EngineLayout& layout, const engine_sim::GasPath& gas) {
  Eigen::VectorXd f(layout.outputs());
  f.head<2>() << gas.n1_dot_rpm_s, gas.n2_dot_rpm_s;
  if (layout.heat_soak) f.segment<engine_sim::metal_count>(2) = Eigen::Vector3d::Map(gas.metal_dot_k_s.data());
  f.segment<engine_sensors>(layout.sensors()) << gas.speeds.n1_rpm, gas.speeds.n2_rpm, gas.s24.pt_pa, gas.s24.tt_k,
      gas.ps_30_pa, gas.s30.tt_k, gas.s48.tt_k;
  f.segment<engine_auxiliary>(layout.auxiliary()) << gas.s40.tt_k, gas.s50.tt_k, gas.net_thrust_n,
      gas.stall_margin_lpc_percent;
  return f;
}

Eigen::VectorXd evaluate(const EngineLayout& layout, const engine_sim::Turbofan& turbofan,
                         const engine_sim::SteadyPoint& near, const Eigen::VectorXd& v) {
  engine_sim::Operation operation = near.operation;
  operation.fuel_flow_kg_s = v(layout.fuel());
  operation.geometry.vsv_deg = v(layout.fuel() + 1);
  operation.geometry.vbv_fraction = v(layout.fuel() + 2);
  for (std::size_t i = 0; i < engine_sim::health_count; ++i)
    operation.health[i] = v(layout.health() + static_cast<Eigen::Index>(i));
  engine_sim::FlowUnknowns unknowns = near.unknowns;
  if (!layout.heat_soak) return outputs_of(layout, turbofan.gas_path(operation, {v(0), v(1)}, unknowns));
  const engine_sim::MetalTemperatures metal{v(2), v(3), v(4)};
  return outputs_of(layout, turbofan.gas_path(operation, {v(0), v(1)}, unknowns, &metal));
}

Eigen::VectorXd input_size(const EngineLayout& layout, const Eigen::VectorXd& v) {
  Eigen::VectorXd size = Eigen::VectorXd::Ones(layout.inputs());
  size.head(layout.fuel() + 1) = v.head(layout.fuel() + 1);
  size(layout.fuel() + 1) = 10.0;
  size(layout.fuel() + 2) = 0.1;
  return size;
}

void name_channels(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::VectorXd& v,
                   const Eigen::VectorXd& f) {
  model.states = {{"Nf", "rpm", v(0)}, {"Nc", "rpm", v(1)}};
  if (layout.heat_soak)
    for (std::size_t i = 0; i < engine_sim::metal_count; ++i)
      model.states.push_back({metal_names[i], "K", v(2 + static_cast<Eigen::Index>(i))});
  const Eigen::Index u = layout.fuel(), y = layout.sensors(), z = layout.auxiliary();
  model.controls = {{"fuel_flow", "kg/s", v(u)}, {"VSV", "deg", v(u + 1)}, {"VBV", "fraction", v(u + 2)}};
  model.health.clear();
  for (std::size_t i = 0; i < engine_sim::health_count; ++i)
    model.health.push_back(
        {std::string(engine_sim::health_names[i]), "fraction", v(layout.health() + static_cast<Eigen::Index>(i))});
  model.sensors = {{"Nf", "rpm", f(y)},      {"Nc", "rpm", f(y + 1)}, {"P24", "Pa", f(y + 2)}, {"T24", "K", f(y + 3)},
                   {"Ps30", "Pa", f(y + 4)}, {"T30", "K", f(y + 5)},  {"T48", "K", f(y + 6)}};
  model.auxiliary = {{"T40", "K", f(z)}, {"T50", "K", f(z + 1)}, {"Fn", "N", f(z + 2)}, {"SmLPC", "percent", f(z + 3)}};
}

void split_jacobian(const EngineLayout& layout, linear_model::LinearModel& model, const Eigen::MatrixXd& J) {
  const Eigen::Index n = layout.states(), u = layout.fuel(), h = layout.health();
  const Eigen::Index y = layout.sensors(), z = layout.auxiliary();
  model.A = J.block(0, 0, n, n);
  model.B = J.block(0, u, n, engine_controls);
  model.L = J.block(0, h, n, engine_health);
  model.C = J.block(y, 0, engine_sensors, n);
  model.D = J.block(y, u, engine_sensors, engine_controls);
  model.M = J.block(y, h, engine_sensors, engine_health);
  model.F = J.block(z, 0, engine_auxiliary, n);
  model.G = J.block(z, u, engine_auxiliary, engine_controls);
  model.N = J.block(z, h, engine_auxiliary, engine_health);
}

}  // namespace ehm::tuner_design
