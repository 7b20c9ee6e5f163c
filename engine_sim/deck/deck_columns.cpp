#include "engine_sim/deck/deck_columns.h"

#include <utility>

namespace ehm::engine_sim {
namespace {

std::vector<DeckInput> make_inputs() {
  const auto required = [](const char* name, double lowest, double highest, double FlightCondition::*value) {
    return DeckInput{name, lowest, highest, true, {}, [value](Operation& o, double x) { o.flight.*value = x; }};
  };
  const auto geometry = [](const char* name, double lowest, double highest, double Geometry::*value) {
    return DeckInput{name, lowest, highest, false, {}, [value](Operation& o, double x) { o.geometry.*value = x; }};
  };
  const auto offtake = [](const char* name, double highest, double Offtake::*value) {
    return DeckInput{name, 0.0, highest, false, {}, [value](Operation& o, double x) { o.offtake.*value = x; }};
  };
  std::vector<DeckInput> inputs{required("altitude_m", -1000.0, 20000.0, &FlightCondition::altitude_m),
                                required("mach", 0.0, 0.95, &FlightCondition::mach),
                                required("delta_isa_k", -60.0, 60.0, &FlightCondition::delta_isa_k),
                                {"fuel_flow_kg_s", 1e-3, 100.0, false, DemandKind::fuel_flow_kg_s},
                                {"net_thrust_n", -1e6, 1e6, false, DemandKind::net_thrust_n},
                                {"t40_k", 200.0, 5000.0, false, DemandKind::t40_k},
                                {"n1_rpm", 1.0, 1e5, false, DemandKind::n1_rpm},
                                geometry("vsv_deg", -20.0, 40.0, &Geometry::vsv_deg),
                                geometry("vbv_fraction", 0.0, 0.5, &Geometry::vbv_fraction),
                                geometry("core_nozzle_area_ratio", 0.5, 2.0, &Geometry::core_nozzle_area_ratio),
                                offtake("customer_bleed_kg_s", 100.0, &Offtake::customer_bleed_kg_s),
                                offtake("power_offtake_w", 1e7, &Offtake::power_w)};
  for (std::size_t i = 0; i < health_count; ++i) {
    inputs.push_back({"health_" + std::string(health_names[i]), -0.5, 0.5, false, {}, [i](Operation& o, double x) {
                        o.health[i] = x;
                      }});
  }
  return inputs;
}

std::vector<DeckOutput> make_outputs() {
  constexpr std::pair<const char*, Station GasPath::*> stations[] = {
      {"2", &GasPath::s2},   {"13", &GasPath::s13}, {"21", &GasPath::s21}, {"24", &GasPath::s24},
      {"30", &GasPath::s30}, {"40", &GasPath::s40}, {"48", &GasPath::s48}, {"50", &GasPath::s50}};
  std::vector<DeckOutput> outputs;
  for (const auto& [number, station] : stations) {
    const std::string n = number;
    const auto of = station;  // a structured binding cannot be captured
    outputs.push_back({"w_" + n + "_kg_s", [of](const GasPath& g) { return (g.*of).w_kg_s; }});
    outputs.push_back({"pt_" + n + "_pa", [of](const GasPath& g) { return (g.*of).pt_pa; }});
    outputs.push_back({"tt_" + n + "_k", [of](const GasPath& g) { return (g.*of).tt_k; }});
  }
  outputs.push_back({"ps_30_pa", &GasPath::ps_30_pa});
  outputs.push_back({"n1_rpm", [](const GasPath& g) { return g.speeds.n1_rpm; }});
  outputs.push_back({"n2_rpm", [](const GasPath& g) { return g.speeds.n2_rpm; }});
  outputs.push_back({"fuel_flow_kg_s", &GasPath::fuel_flow_kg_s});
  outputs.push_back({"net_thrust_n", &GasPath::net_thrust_n});
  outputs.push_back({"bypass_ratio", &GasPath::bypass_ratio});
  outputs.push_back({"overall_pressure_ratio", &GasPath::overall_pressure_ratio});
  outputs.push_back({"stall_margin_fan", &GasPath::stall_margin_fan_percent});
  outputs.push_back({"stall_margin_lpc", &GasPath::stall_margin_lpc_percent});
  outputs.push_back({"stall_margin_hpc", &GasPath::stall_margin_hpc_percent});
  return outputs;
}

}  // namespace

const std::vector<DeckInput>& deck_inputs() {
  static const std::vector<DeckInput> inputs = make_inputs();
  return inputs;
}

const std::vector<DeckOutput>& deck_outputs() {
  static const std::vector<DeckOutput> outputs = make_outputs();
  return outputs;
}

}  // namespace ehm::engine_sim
