// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/endurthi/closed_loop.h"

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/control/controlled_engine.h"

namespace ehm::tuner_design::endurthi {
namespace {

engine_sim::SteadyPoint begun_at(const StudyPoint& point, const Eigen::VectorXd& states) {
  engine_sim::SteadyPoint start = point.trim;
  start.gas.speeds.n1_rpm += states(0);
  start.gas.speeds.n2_rpm += states(1);
  start.gas.metal_k[engine_sim::lpt_metal] += states(2);
  return start;
}

}  // namespace

Record closed_loop(const StudyPoint& point, const Eigen::VectorXd& states, const Eigen::VectorXd& health,
                   double seconds, double step_s) {
  const EngineLayout& layout = point.engine->layout;
  const auto samples = static_cast<Eigen::Index>(std::lround(seconds / step_s)) + 1;
  Record record{.step_s = step_s,
                .x0 = states,
                .h = health,
                .u = Eigen::MatrixXd(point.plant.controls, samples),
                .y = Eigen::MatrixXd(point.sensors(), samples)};
  engine_sim::ControlledEngine engine(point.engine->turbofan, point.engine->control(), begun_at(point, states),
                                      engine_sim::HeatSoak::with);
  const engine_sim::Surroundings surroundings{point.flight, point.health_of(health), {}};
  for (Eigen::Index k = 0; k < samples; ++k) {
    const engine_sim::ControlledSample now = engine.step(surroundings, point.n1_rpm, step_s);
    engine_sim::Operation operation = point.trim.operation;
    operation.fuel_flow_kg_s = now.actuation.fuel_flow_kg_s;
    operation.geometry = now.geometry;
    Eigen::Index at = 0;
    for (const auto* control : layout.channels().controls) record.u(at++, k) = control->of(operation);
    record.y.col(k) = outputs_of(layout, now.gas).segment(layout.sensors(), layout.sensor_count());
  }
  record.u.colwise() -= point.control_trim();
  record.y.colwise() -= point.sensor_trim();
  return record;
}

}  // namespace ehm::tuner_design::endurthi
