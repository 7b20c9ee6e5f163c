// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engines/data_json.h"

#include "engine_sim/engines/json_fields.h"
#include "engine_sim/engines/map_json.h"

namespace ehm::engine_sim {
namespace {

using files::Json;
using files::JsonObject;

constexpr std::size_t longest_name = 63;  // on the wire

constexpr NumberField<EngineData> root_fields[] = {
    {"hpc_exit_area_m2", &EngineData::hpc_exit_area_m2, 1e-4, 10.0, "m2"},
    {"lp_inertia_kg_m2", &EngineData::lp_inertia_kg_m2, 1e-3, 1e5, "kg m2"},
    {"hp_inertia_kg_m2", &EngineData::hp_inertia_kg_m2, 1e-3, 1e5, "kg m2"}};
constexpr NumberField<MapScale> scale_fields[] = {
    {"speed", &MapScale::s_nc, 1e-3, 1e5, "rpm at map speed 1; turbines rpm/sqrt(R) per percent"},
    {"flow", &MapScale::s_wc, 1e-6, 1e6, "ratio to the map"},
    {"pressure_rise", &MapScale::s_pr, 1e-3, 1e3, "of PR - 1"},
    {"efficiency", &MapScale::s_eff, 0.1, 2.0, "ratio to the map"}};
constexpr NumberField<VaneData> vane_fields[] = {
    {"flow_per_deg", &VaneData::flow_per_deg, 0.0, 0.024, "1/deg"},  // at 40 degrees something must be left
    {"pressure_rise_per_deg", &VaneData::pressure_rise_per_deg, 0.0, 0.024, "1/deg"},
    {"efficiency_per_deg2", &VaneData::efficiency_per_deg2, 0.0, 5e-4, "1/deg2"}};
constexpr NumberField<SecondaryAir> air_fields[] = {
    {"hpt_inlet", &SecondaryAir::hpt_inlet, 0.0, 0.3, "of the HPC's inlet flow"},
    {"hpt_exit", &SecondaryAir::hpt_exit, 0.0, 0.3, "of the HPC's inlet flow"},
    {"lpt_inlet", &SecondaryAir::lpt_inlet, 0.0, 0.3, "of the HPC's inlet flow"},
    {"lpt_exit", &SecondaryAir::lpt_exit, 0.0, 0.3, "of the HPC's inlet flow"},
    {"lpt_port_work", &SecondaryAir::lpt_port_work, 0.0, 1.0, "of the HPC's work"},
    {"customer_port_work", &SecondaryAir::customer_port_work, 0.0, 1.0, "of the HPC's work"},
    {"bypass_leak", &SecondaryAir::bypass_leak, 0.0, 0.3, "of the bypass flow"}};
constexpr NumberField<CombustorData> combustor_fields[] = {
    {"pressure_loss", &CombustorData::pressure_loss, 0.0, 0.3, "dP/P"},
    {"efficiency", &CombustorData::efficiency, 0.5, 1.0, "ratio"},
    {"lower_heating_value_j_kg", &CombustorData::lower_heating_value_j_kg, 1e7, 1.5e8, "J/kg"},
    {"fuel_enthalpy_j_kg", &CombustorData::fuel_enthalpy_j_kg, -1e7, 1e7, "J/kg"}};
constexpr NumberField<NozzleData> nozzle_fields[] = {
    {"area_m2", &NozzleData::area_m2, 1e-4, 20.0, "m2"},
    {"velocity_coefficient", &NozzleData::velocity_coefficient, 0.5, 1.0, "ratio"}};
constexpr NumberField<DuctLosses> loss_fields[] = {{"bypass", &DuctLosses::bypass, 0.0, 0.3, "dP/P"},
                                                   {"fan_to_lpc", &DuctLosses::fan_to_lpc, 0.0, 0.3, "dP/P"},
                                                   {"lpc_to_hpc", &DuctLosses::lpc_to_hpc, 0.0, 0.3, "dP/P"},
                                                   {"hpt_to_lpt", &DuctLosses::hpt_to_lpt, 0.0, 0.3, "dP/P"},
                                                   {"lpt_to_nozzle", &DuctLosses::lpt_to_nozzle, 0.0, 0.3, "dP/P"}};
constexpr NumberField<HeatSoakData> metal_fields[] = {
    {"conductance_w_k", &HeatSoakData::conductance_w_k, 1.0, 1e7, "W/K"},
    {"capacity_j_k", &HeatSoakData::capacity_j_k, 1.0, 1e9, "J/K"}};
constexpr NumberField<Ratings> rating_fields[] = {
    {"t40_max_k", &Ratings::t40_max_k, 500.0, 2000.0, "K"},  // where the gas data end
    {"t48_max_k", &Ratings::t48_max_k, 500.0, 2000.0, "K"},
    {"p30_max_pa", &Ratings::p30_max_pa, 1e5, 1e7, "Pa"},
    {"n1_max_rpm", &Ratings::n1_max_rpm, 100.0, 1e5, "rpm"},
    {"n2_max_rpm", &Ratings::n2_max_rpm, 100.0, 1e5, "rpm"},
    {"corrected_n1_max_rpm", &Ratings::corrected_n1_max_rpm, 100.0, 1e5, "rpm"},
    {"corrected_n2_max_rpm", &Ratings::corrected_n2_max_rpm, 100.0, 1e5, "rpm"},
    {"ground_idle_corrected_n2_rpm", &Ratings::ground_idle_corrected_n2_rpm, 100.0, 1e5, "rpm"},
    {"flight_idle_corrected_n2_rpm", &Ratings::flight_idle_corrected_n2_rpm, 100.0, 1e5, "rpm"}};
constexpr NumberField<FlightCondition> flight_fields[] = {
    {"altitude_m", &FlightCondition::altitude_m, -1000.0, 20000.0, "m"},
    {"mach", &FlightCondition::mach, 0.0, 0.95, "Mach"},
    {"delta_isa_k", &FlightCondition::delta_isa_k, -60.0, 60.0, "K"}};
constexpr NumberField<SpoolSpeeds> speed_fields[] = {{"n1_rpm", &SpoolSpeeds::n1_rpm, 100.0, 1e5, "rpm"},
                                                     {"n2_rpm", &SpoolSpeeds::n2_rpm, 100.0, 1e5, "rpm"}};
constexpr NumberField<DesignPoint> design_fields[] = {
    {"fuel_flow_kg_s", &DesignPoint::fuel_flow_kg_s, 1e-3, 100.0, "kg/s"}};
constexpr NumberField<Offtake> offtake_fields[] = {
    {"customer_bleed_kg_s", &Offtake::customer_bleed_kg_s, 0.0, 100.0, "kg/s"},
    {"power_offtake_w", &Offtake::power_w, 0.0, 1e7, "W"}};
using U = FlowUnknownsOf<double>;
constexpr NumberField<U> unknown_fields[] = {
    {"bypass_ratio", &U::bypass_ratio, 0.1, 40.0, "W13/W21"},
    {"r_line_fan", &U::r_line_fan, -1.0, 8.0, "R-line, 1 is surge"},
    {"r_line_lpc", &U::r_line_lpc, -1.0, 8.0, "R-line, 1 is surge"},
    {"r_line_hpc", &U::r_line_hpc, -1.0, 8.0, "R-line, 1 is surge"},
    {"pressure_ratio_hpt", &U::pressure_ratio_hpt, 1.02, 8.0, "expansion ratio"},
    {"pressure_ratio_lpt", &U::pressure_ratio_lpt, 1.02, 12.0, "expansion ratio"}};

constexpr const char* metal_names[metal_count]{"hpc", "hpt", "lpt"};

CompressorData compressor_from(JsonObject& root, const char* key) {
  JsonObject object(root.at(key), root.file(), root.key(key));
  CompressorData data{compressor_map_from(object, "map"), object_of(object, "scale", scale_fields), {}};
  if (object.find("vanes") != nullptr) data.vanes = object_of(object, "vanes", vane_fields);
  object.refuse_unknown();
  return data;
}

Json to_json(const CompressorData& data) {
  return {{"map", to_json(data.map)},
          {"scale", json_of(scale_fields, data.scale)},
          {"vanes", json_of(vane_fields, data.vanes)}};
}

TurbineData turbine_from(JsonObject& root, const char* key) {
  JsonObject object(root.at(key), root.file(), root.key(key));
  TurbineData data{turbine_map_from(object, "map"), object_of(object, "scale", scale_fields)};
  object.refuse_unknown();
  return data;
}

Json to_json(const TurbineData& data) {
  return {{"map", to_json(data.map)}, {"scale", json_of(scale_fields, data.scale)}};
}

InletData inlet_from(JsonObject& root) {
  JsonObject object(root.at("inlet"), root.file(), root.key("inlet"));
  InletData inlet;
  for (const auto& [mach, recovery] : pair_list(object, "ram_recovery", 0.5, 1.0, "total pressure ratio"))
    inlet.ram_recovery.push_back({mach, recovery});
  object.refuse_unknown();
  return inlet;
}

Json to_json(const InletData& inlet) {
  NumberPairs pairs;
  for (const auto& [mach, recovery] : inlet.ram_recovery) pairs.emplace_back(mach, recovery);
  return {{"ram_recovery", pairs_to_json(pairs)}};
}

SecondaryAir air_from(JsonObject& root) {
  constexpr double most = 0.5;
  const SecondaryAir air = object_of(root, "secondary_air", air_fields);
  const double sum = air.hpt_inlet + air.hpt_exit + air.lpt_inlet + air.lpt_exit;
  if (sum > most)
    throw_field_defect(root, "secondary_air", files::shown(sum) + " of the HPC's inlet flow together",
                       "at most " + files::shown(most), "Leave air to burn");
  return air;
}

std::array<HeatSoakData, metal_count> metal_from(JsonObject& root) {
  JsonObject object(root.at("metal"), root.file(), root.key("metal"));
  std::array<HeatSoakData, metal_count> metal{};
  for (std::size_t i = 0; i < metal_count; ++i) metal[i] = object_of(object, metal_names[i], metal_fields);
  object.refuse_unknown();
  return metal;
}

Ratings ratings_from(JsonObject& root) {
  const Ratings r = object_of(root, "ratings", rating_fields);
  if (!(r.ground_idle_corrected_n2_rpm <= r.flight_idle_corrected_n2_rpm &&
        r.flight_idle_corrected_n2_rpm < r.corrected_n2_max_rpm))
    throw_field_defect(root, "ratings.flight_idle_corrected_n2_rpm", files::shown(r.flight_idle_corrected_n2_rpm),
                       "from ground_idle_corrected_n2_rpm (" + files::shown(r.ground_idle_corrected_n2_rpm) +
                           ") to below corrected_n2_max_rpm (" + files::shown(r.corrected_n2_max_rpm) + ")",
                       "Correct one of them");
  return r;
}

DesignPoint design_from(JsonObject& root) {
  JsonObject object(root.at("design_point"), root.file(), root.key("design_point"));
  DesignPoint design{};
  read_fields(object, flight_fields, design.flight);
  read_fields(object, speed_fields, design.speeds);
  read_fields(object, design_fields, design);
  read_fields(object, offtake_fields, design.offtake);
  read_fields<U>(object, unknown_fields, design.unknowns);
  object.refuse_unknown();
  return design;
}

Json to_json(const DesignPoint& design) {
  Json json = json_of(flight_fields, design.flight);
  write_fields(json, speed_fields, design.speeds);
  write_fields(json, design_fields, design);
  write_fields(json, offtake_fields, design.offtake);
  write_fields<U>(json, unknown_fields, design.unknowns);
  return json;
}

std::string name_from(JsonObject& root) {
  const std::string name = root.text("name");
  if (name.size() > longest_name)
    throw_field_defect(root, "name", std::to_string(name.size()) + " characters long",
                       "1 to " + std::to_string(longest_name) + " characters", "Shorten it");
  return name;
}

}  // namespace

EngineData engine_data_from(JsonObject& root) {
  EngineData data{.name = name_from(root),
                  .inlet = inlet_from(root),
                  .fan = compressor_from(root, "fan"),
                  .lpc = compressor_from(root, "lpc"),
                  .hpc = compressor_from(root, "hpc"),
                  .hpc_exit_area_m2 = 0.0,
                  .air = air_from(root),
                  .combustor = object_of(root, "combustor", combustor_fields),
                  .hpt = turbine_from(root, "hpt"),
                  .lpt = turbine_from(root, "lpt"),
                  .loss = object_of(root, "duct_losses", loss_fields),
                  .core_nozzle = object_of(root, "core_nozzle", nozzle_fields),
                  .bypass_nozzle = object_of(root, "bypass_nozzle", nozzle_fields),
                  .lp_inertia_kg_m2 = 0.0,
                  .hp_inertia_kg_m2 = 0.0,
                  .metal = metal_from(root),
                  .ratings = ratings_from(root),
                  .design = design_from(root)};
  read_fields(root, root_fields, data);
  return data;
}

void add_engine_data(Json& root, const EngineData& data) {
  root["name"] = data.name;
  root["inlet"] = to_json(data.inlet);
  root["fan"] = to_json(data.fan);
  root["lpc"] = to_json(data.lpc);
  root["hpc"] = to_json(data.hpc);
  root["secondary_air"] = json_of(air_fields, data.air);
  root["combustor"] = json_of(combustor_fields, data.combustor);
  root["hpt"] = to_json(data.hpt);
  root["lpt"] = to_json(data.lpt);
  root["duct_losses"] = json_of(loss_fields, data.loss);
  root["core_nozzle"] = json_of(nozzle_fields, data.core_nozzle);
  root["bypass_nozzle"] = json_of(nozzle_fields, data.bypass_nozzle);
  for (std::size_t i = 0; i < metal_count; ++i) root["metal"][metal_names[i]] = json_of(metal_fields, data.metal[i]);
  root["ratings"] = json_of(rating_fields, data.ratings);
  root["design_point"] = to_json(data.design);
  write_fields(root, root_fields, data);
}

}  // namespace ehm::engine_sim
