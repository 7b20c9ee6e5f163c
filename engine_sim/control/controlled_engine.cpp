// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/control/controlled_engine.h"

#include "engine_sim/model/ratings.h"

namespace ehm::engine_sim {
namespace {

Measurements at(Measurements measured, const SpoolSpeeds& speeds, const Intake& intake, bool on_ground) {
  measured.n1_rpm = speeds.n1_rpm;
  measured.n2_rpm = speeds.n2_rpm;
  measured.t2_k = intake.tt_k;
  measured.p2_pa = intake.fan_face_pt_pa;
  measured.on_ground = on_ground;
  return measured;
}

}  // namespace

ControlledEngine::ControlledEngine(const Turbofan& engine, const ControlData& data, const SteadyPoint& start,
                                   HeatSoak heat_soak, Motion motion)
    : engine_(engine),
      control_(data, measure(start.gas, on_ground(start.operation.flight)), start.operation.fuel_flow_kg_s),
      transient_(engine, start, heat_soak, motion),
      measured_(measure(start.gas, on_ground(start.operation.flight))) {}

ControlledSample ControlledEngine::step(const Surroundings& surroundings, double n1_demand_rpm, double dt_s) {
  measured_ = at(measured_, transient_.speeds(), intake(engine_.data().inlet, surroundings.flight),
                 on_ground(surroundings.flight));
  const Actuation actuation = control_.update(measured_, n1_demand_rpm, dt_s);
  const Operation operation{.flight = surroundings.flight,
                            .health = surroundings.health,
                            .fuel_flow_kg_s = actuation.fuel_flow_kg_s,
                            .geometry = geometry(control_.data().vanes, actuation, measured_),
                            .offtake = surroundings.offtake};
  const GasPath gas = transient_.output(operation);
  measured_ = measure(gas, on_ground(surroundings.flight));
  transient_.step(operation, dt_s);
  return {actuation, operation.geometry, gas};
}

}  // namespace ehm::engine_sim
