// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/engine_command/station_diagram.h"

#include <algorithm>
#include <iomanip>
#include <ostream>
#include <sstream>

#include "engine_sim/engines/engine_file.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::engine_sim {
namespace {

constexpr const char* diagram = R"(
              +--13-- bypass duct ------------------------------------------> bypass nozzle
 --> 2 -- fan +
              +--21-- LPC --24-- HPC --30-- combustor --40-- HPT --48-- LPT --50-- core nozzle

)";

struct StationRow {
  const char *number, *place;
};
constexpr StationRow stations[] = {{"2", "fan face"},        {"13", "fan exit, bypass"}, {"21", "fan exit, core"},
                                   {"24", "LPC exit"},       {"30", "HPC exit"},         {"40", "burner exit"},
                                   {"48", "behind the HPT"}, {"50", "LPT exit"}};

/// W2, P2, T2 and so on: they stand in the table of stations.
bool is_of_a_station(const OutputChannel& channel) {
  return std::any_of(std::begin(stations), std::end(stations), [&](const StationRow& row) {
    return channel.name.size() > 1 && channel.name.substr(1) == row.number;
  });
}

void print_stations(const GasPath& gas, const Ratings& ratings, std::ostream& out) {
  out << " station                W, kg/s      Pt, kPa        Tt, K\n";
  for (const auto& [number, place] : stations) {
    const auto read = [&, at = number](const char* quantity) {  // clang 14 captures no binding
      return find_output(quantity + std::string(at))->read(gas, ratings);
    };
    out << ' ' << std::left << std::setw(4) << number << std::setw(17) << place << std::right << std::fixed
        << std::setprecision(3) << std::setw(9) << read("W") << std::setw(13) << 1e-3 * read("P")
        << std::setprecision(2) << std::setw(13) << read("T") << '\n';
  }
  out << std::defaultfloat << std::setprecision(6);
}

void print_others(const GasPath& gas, const Ratings& ratings, std::ostream& out) {
  out << '\n';
  for (const OutputChannel& channel : output_channels()) {
    if (is_of_a_station(channel) || channel.column.empty()) continue;
    out << ' ' << std::left << std::setw(7) << channel.name << std::right << std::setw(12) << channel.read(gas, ratings)
        << ' ' << std::left << std::setw(9) << channel.unit << channel.description << std::right << '\n';
  }
}

template <class Channels, class Text>
std::string listed(const Channels& channels, Text text) {
  std::ostringstream list;
  for (const auto& channel : channels) list << (list.tellp() > 0 ? ", " : "") << text(channel);
  return list.str();
}

std::string sensor_text(const SensorChannel& sensor) {
  std::ostringstream text;
  text << sensor.quantity->name << ' ' << sensor.noise_percent << " %";
  if (sensor.lag_s > 0.0) text << " lag " << sensor.lag_s << " s";
  if (sensor.resolution > 0.0) text << " in steps of " << sensor.resolution << ' ' << sensor.quantity->unit;
  return text.str();
}

void print_channels(const NamedChannels& channels, std::ostream& out) {
  out << "\n sensors    " << listed(channels.sensors, sensor_text) << "\n auxiliary  "
      << listed(channels.auxiliary, [](const OutputChannel* c) { return c->name; }) << "\n controls   "
      << listed(channels.controls, [](const ControlChannel* c) { return c->name; }) << "\n health     "
      << listed(channels.health,
                [](const HealthChannel& h) {
                  std::ostringstream text;
                  text << health_names[h.parameter] << ' ' << h.sigma;
                  return text.str();
                })
      << '\n';
}

}  // namespace

void print_engine(const EngineDefinition& engine, std::ostream& out) {
  const DesignPoint& d = engine.data.design;
  const SteadyPoint point = solve_steady(Turbofan(engine.data), {.flight = d.flight, .offtake = d.offtake},
                                         {DemandKind::fuel_flow_kg_s, d.fuel_flow_kg_s});
  out << engine.data.name << ", hash " << engine_hash(engine) << '\n';
  if (!engine.source.empty()) out << "Source: " << engine.source << '\n';
  out << "Design point: " << d.flight.altitude_m << " m, Mach " << d.flight.mach << ", ISA " << std::showpos
      << d.flight.delta_isa_k << std::noshowpos << " K, customer bleed " << d.offtake.customer_bleed_kg_s
      << " kg/s, power off-take " << 1e-3 * d.offtake.power_w << " kW\n"
      << diagram;
  print_stations(point.gas, engine.data.ratings, out);
  print_others(point.gas, engine.data.ratings, out);
  print_channels(engine.channels, out);
}

}  // namespace ehm::engine_sim
