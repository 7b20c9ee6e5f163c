#include "tuner_design/engine_channels.h"

namespace ehm::bench {

using estimation::Channel;

Eigen::VectorXd inputs_of(const engine::SteadyPoint& point) {
  Eigen::VectorXd v(engine_inputs);
  v(0) = point.gas.speeds.n1_rpm;
  v(1) = point.gas.speeds.n2_rpm;
  v(2) = point.operation.fuel_flow_kg_s;
  for (std::size_t i = 0; i < engine::health_count; ++i)
    v(engine_states + engine_controls + static_cast<Eigen::Index>(i)) = point.operation.health[i];
  return v;
}

Eigen::VectorXd outputs_of(const engine::GasPath& gas) {
  Eigen::VectorXd f(engine_outputs);
  f << gas.n1_dot_rpm_s, gas.n2_dot_rpm_s,                                         // rates
      gas.speeds.n1_rpm, gas.speeds.n2_rpm, gas.s24.pt_pa, gas.s24.tt_k,           // sensors
      gas.ps_30_pa, gas.s30.tt_k, gas.s48.tt_k,                                    //
      gas.s40.tt_k, gas.s50.tt_k, gas.net_thrust_n, gas.stall_margin_lpc_percent;  // auxiliary
  return f;
}

Eigen::VectorXd evaluate(const engine::Turbofan& turbofan, const engine::SteadyPoint& near, const Eigen::VectorXd& v) {
  engine::Operation operation = near.operation;
  operation.fuel_flow_kg_s = v(2);
  for (std::size_t i = 0; i < engine::health_count; ++i)
    operation.health[i] = v(engine_states + engine_controls + static_cast<Eigen::Index>(i));
  engine::FlowUnknowns unknowns = near.unknowns;
  return outputs_of(turbofan.gas_path(operation, {v(0), v(1)}, unknowns));
}

void name_channels(estimation::LinearModel& model, const Eigen::VectorXd& v, const Eigen::VectorXd& f) {
  model.states = {{"Nf", "rpm", v(0)}, {"Nc", "rpm", v(1)}};
  model.controls = {{"fuel_flow", "kg/s", v(2)}};
  model.health.clear();
  for (std::size_t i = 0; i < engine::health_count; ++i)
    model.health.push_back({std::string(engine::health_names[i]), "fraction",
                            v(engine_states + engine_controls + static_cast<Eigen::Index>(i))});
  model.sensors = {{"Nf", "rpm", f(2)},  {"Nc", "rpm", f(3)}, {"P24", "Pa", f(4)}, {"T24", "K", f(5)},
                   {"Ps30", "Pa", f(6)}, {"T30", "K", f(7)},  {"T48", "K", f(8)}};
  model.auxiliary = {{"T40", "K", f(9)}, {"T50", "K", f(10)}, {"Fn", "N", f(11)}, {"SmLPC", "percent", f(12)}};
}

void split_jacobian(estimation::LinearModel& model, const Eigen::MatrixXd& J) {
  const Eigen::Index u = engine_states, h = engine_states + engine_controls;
  const Eigen::Index y = engine_rates, z = engine_rates + engine_sensors;
  model.A = J.block(0, 0, engine_rates, engine_states);
  model.B = J.block(0, u, engine_rates, engine_controls);
  model.L = J.block(0, h, engine_rates, engine_health);
  model.C = J.block(y, 0, engine_sensors, engine_states);
  model.D = J.block(y, u, engine_sensors, engine_controls);
  model.M = J.block(y, h, engine_sensors, engine_health);
  model.F = J.block(z, 0, engine_auxiliary, engine_states);
  model.G = J.block(z, u, engine_auxiliary, engine_controls);
  model.N = J.block(z, h, engine_auxiliary, engine_health);
}

}  // namespace ehm::bench
