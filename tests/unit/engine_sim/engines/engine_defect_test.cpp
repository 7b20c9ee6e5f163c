// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "engine_sim/engines/engine_file.h"
#include "engine_sim/engines/jt9d_engine.h"

namespace {

using namespace ehm;
using namespace ehm::engine_sim;
using files::Json;

struct Defect {
  const char* name;
  std::function<void(Json&)> spoil;
  const char* message;
};

void PrintTo(const Defect& defect, std::ostream* out) {
  *out << defect.name;
}

/// Of a JT9D that is spoilt so; empty if it is taken.
std::string message_after(const std::function<void(Json&)>& spoil) {
  static const std::string good = engine_text(jt9d_engine());
  Json json = Json::parse(good);
  spoil(json);
  try {
    engine_from_text(json.dump(), "engine.json");
    return "";
  } catch (const files::FileError& error) {
    return error.what();
  }
}

class EngineFileDefect : public testing::TestWithParam<Defect> {};

TEST_P(EngineFileDefect, HasItsMessage) {
  EXPECT_EQ(message_after(GetParam().spoil), std::string("engine.json: ") + GetParam().message);
}

const Defect defects[] = {
    {"Schema", [](Json& j) { j["schema"] = "ehm-engine/0"; },
     "schema is \"ehm-engine/0\"; allowed: \"ehm-engine/1\". Convert the file to this format."},
    {"UnknownKey", [](Json& j) { j["inlet"]["recovery"] = 1; },
     "key inlet.recovery is unknown; allowed here: ram_recovery. Correct the spelling or remove it."},
    {"MissingKey", [](Json& j) { j["fan"]["scale"].erase("flow"); }, "key fan.scale.flow is missing. Add it."},
    {"TextForNumber", [](Json& j) { j["lp_inertia_kg_m2"] = "135"; },
     "lp_inertia_kg_m2 is \"135\"; allowed: a finite number. Write the number, or derive the matrix again."},
    {"OutOfRange", [](Json& j) { j["combustor"]["lower_heating_value_j_kg"] = 18400; },
     "combustor.lower_heating_value_j_kg is 18400.0; allowed: 10000000.0 to 150000000.0 (J/kg). Correct the value."},
    {"Temperature", [](Json& j) { j["ratings"]["t40_max_k"] = 2826; },
     "ratings.t40_max_k is 2826.0; allowed: 500.0 to 2000.0 (K). Correct the value."},
    {"IdleAboveMaximum", [](Json& j) { j["ratings"]["flight_idle_corrected_n2_rpm"] = 9000; },
     "ratings.flight_idle_corrected_n2_rpm is 9000.0; allowed: from ground_idle_corrected_n2_rpm (6090.0) to below "
     "corrected_n2_max_rpm (8500.0). Correct one of them."},
    {"NoAirLeft", [](Json& j) { j["secondary_air"]["hpt_inlet"] = j["secondary_air"]["hpt_exit"] = 0.3; },
     "secondary_air is 0.6 of the HPC's inlet flow together; allowed: at most 0.5. Leave air to burn."},
    {"LongName", [](Json& j) { j["name"] = std::string(64, 'x'); },
     "name is 64 characters long; allowed: 1 to 63 characters. Shorten it."},
    {"MachOrder", [](Json& j) { j["inlet"]["ram_recovery"][2][0] = 0.05; },
     "inlet.ram_recovery[2][0] is 0.05; allowed: more than 0.1, the point before. Put the points into ascending "
     "order."},
    // maps
    {"BreaksDescend", [](Json& j) { j["fan"]["map"]["speed_breaks"][3] = 0.55; },
     "fan.map.speed_breaks[3] is 0.55; allowed: more than 0.6, the one before. Put them into ascending order."},
    {"RowMissing", [](Json& j) { j["lpc"]["map"]["flow"].erase(0); },
     "lpc.map.flow is 12 rows high; allowed: 13 rows of 12 numbers. Check the matrix against the channel lists."},
    {"EfficiencyAboveOne",
     [](Json& j) {
       for (Json& row : j["hpt"]["map"]["efficiency"])
         for (Json& number : row) number = 1.01;
     },
     "hpt.map.efficiency is 1.01 at speed 60.0, pressure ratio 3.0; allowed: above 0.0 to 1.0. Fit the map again."},
    {"SurgeLineFalls",
     [](Json& j) {
       Json& surge = j["hpc"]["map"]["surge_pressure_ratio"];
       for (std::size_t i = 0; i < surge.size(); ++i) surge[i] = 10.0 - 0.5 * static_cast<double>(i);
     },
     nullptr},
    {"FlowFallsWithSpeed",
     [](Json& j) {
       Json& flow = j["fan"]["map"]["flow"];
       for (std::size_t i = 0; i < flow.size(); ++i)
         for (Json& number : flow[i]) number = 4000.0 * std::pow(0.3, static_cast<double>(i));
     },
     nullptr},
    // control
    {"DecelerationAboveAcceleration", [](Json& j) { j["control"]["fuel"]["deceleration"][3][1] = 1.2; },
     "control.fuel.deceleration is 1.2 at N2 corrected 7200.0 rpm; allowed: less than acceleration, 1.12 there. "
     "Correct "
     "one of them."},
    {"EmptySchedule", [](Json& j) { j["control"]["vanes"]["schedule_deg"] = Json::array(); },
     "control.vanes.schedule_deg is 0 points long; allowed: 1 to 32 points [at, value]. Correct the list."},
    {"FuelRange", [](Json& j) { j["control"]["fuel"]["fuel_max_kg_s"] = 0.01; },
     "control.fuel.fuel_min_kg_s is 0.02; allowed: less than fuel_max_kg_s, 0.01. Correct one of them."},
    // channels
    {"UnknownSensor", [](Json& j) { j["channels"]["sensors"][2]["name"] = "P25"; }, nullptr},
    {"SensorTwice", [](Json& j) { j["channels"]["sensors"][2]["name"] = "Nf"; },
     "channels.sensors[2].name is \"Nf\" again; allowed: each name once. Remove one of them."},
    {"Noise", [](Json& j) { j["channels"]["sensors"][0]["noise_percent"] = 25; },
     "channels.sensors[0].noise_percent is 25.0; allowed: 0.0 to 20.0 (percent). Correct the value."},
    {"NoSensor", [](Json& j) { j["channels"]["sensors"] = Json::array(); },
     "channels.sensors is 0 long; allowed: 1 to 16 channels. Correct the list."},
    {"TooManyOutputs",
     [](Json& j) { j["channels"]["auxiliary"] = {"W2", "P2", "T2", "W13", "P13", "T13", "W21", "P21", "T21"}; },
     "channels.auxiliary is 9 long; allowed: 0 to 8 channels. Correct the list."},
    {"NumberForName", [](Json& j) { j["channels"]["auxiliary"][1] = 50; },
     "channels.auxiliary[1] is 50; allowed: a name in quotes. Write it in quotes."},
    {"NoFuel", [](Json& j) { j["channels"]["controls"] = {"VSV"}; },
     "channels.controls is [\"VSV\"]; allowed: a list with fuel_flow. Add it."},
    {"UnknownControl", [](Json& j) { j["channels"]["controls"][1] = "IGV"; },
     "channels.controls[1] is \"IGV\"; allowed: fuel_flow, VSV, VBV, A8, customer_bleed, power_offtake. Correct the "
     "name."},
    {"UnknownHealth", [](Json& j) { j["channels"]["health"][0]["name"] = "fan_eff"; },
     "channels.health[0].name is \"fan_eff\"; allowed: fan_efficiency, fan_flow, lpc_efficiency, lpc_flow, "
     "hpc_efficiency, hpc_flow, hpt_efficiency, hpt_flow, lpt_efficiency, lpt_flow. Correct the name."},
    {"NoSpread", [](Json& j) { j["channels"]["health"][0]["sigma"] = 0; },
     "channels.health[0].sigma is 0.0; allowed: 1e-06 to 0.2 (fraction). Correct the value."}};

// Where the message holds a long list or numbers of a fit, what begins it.
TEST(EngineFile, LongMessagesBeginWithTheKey) {
  for (const auto& [name, start] :
       {std::pair{"SurgeLineFalls", "engine.json: hpc.map.surge_pressure_ratio is "},
        {"FlowFallsWithSpeed", "engine.json: fan.map.flow is "},
        {"UnknownSensor", "engine.json: channels.sensors[2].name is \"P25\"; allowed: W2, P2, T2, W13, "}})
    for (const Defect& defect : defects) {
      if (defect.name != std::string(name)) continue;
      EXPECT_EQ(message_after(defect.spoil).substr(0, std::string(start).size()), start) << name;
    }
}

std::vector<Defect> with_whole_message() {
  std::vector<Defect> list;
  for (const Defect& defect : defects)
    if (defect.message != nullptr) list.push_back(defect);
  return list;
}

INSTANTIATE_TEST_SUITE_P(All, EngineFileDefect, testing::ValuesIn(with_whole_message()),
                         [](const auto& tested) { return tested.param.name; });

}  // namespace
