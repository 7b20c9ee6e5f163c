// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/deck/deck_columns.h"

namespace ehm::engine_sim {
namespace {

std::vector<DeckInput> make_inputs() {
  const auto required = [](const char* name, double lowest, double highest, double FlightCondition::*value) {
    return DeckInput{name, lowest, highest, true, {}, [value](Operation& o, double x) { o.flight.*value = x; }};
  };
  std::vector<DeckInput> inputs{required("altitude_m", -1000.0, 20000.0, &FlightCondition::altitude_m),
                                required("mach", 0.0, 0.95, &FlightCondition::mach),
                                required("delta_isa_k", -60.0, 60.0, &FlightCondition::delta_isa_k),
                                {"fuel_flow_kg_s", 1e-3, 100.0, false, DemandKind::fuel_flow_kg_s},
                                {"net_thrust_n", -1e6, 1e6, false, DemandKind::net_thrust_n},
                                {"t40_k", 200.0, 5000.0, false, DemandKind::t40_k},
                                {"n1_rpm", 1.0, 1e5, false, DemandKind::n1_rpm}};
  for (const ControlChannel& control : control_channels()) {
    if (control.name == "fuel_flow") continue;  // a demand
    inputs.push_back({std::string(control.column),
                      control.lowest,
                      control.highest,
                      false,
                      {},
                      [of = control.of](Operation& o, double x) { of(o) = x; }});
  }
  for (std::size_t i = 0; i < health_count; ++i) {
    inputs.push_back({"health_" + std::string(health_names[i]), -0.5, 0.5, false, {}, [i](Operation& o, double x) {
                        o.health[i] = x;
                      }});
  }
  return inputs;
}

std::vector<const OutputChannel*> make_outputs() {
  std::vector<const OutputChannel*> outputs;
  for (const OutputChannel& channel : output_channels())
    if (!channel.column.empty()) outputs.push_back(&channel);
  return outputs;
}

}  // namespace

const std::vector<DeckInput>& deck_inputs() {
  static const std::vector<DeckInput> inputs = make_inputs();
  return inputs;
}

const std::vector<const OutputChannel*>& deck_outputs() {
  static const std::vector<const OutputChannel*> outputs = make_outputs();
  return outputs;
}

}  // namespace ehm::engine_sim
