// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/flight_entry.h"

#include <cmath>
#include <limits>

#include "deploy/runtime/files/file_error.h"
#include "idl/wire_names.h"
#include "monitor/checkpoint/state_json.h"

namespace ehm::monitor {

namespace {

using files::Json;
using files::JsonObject;

constexpr auto most_count = std::numeric_limits<std::uint32_t>::max();
constexpr const char* remedy = "Remove the line";

Json health_to_json(const std::vector<Flight::Health>& health) {
  Json json = Json::array();
  for (const auto& h : health)
    json.push_back({{"name", h.name}, {"unit", h.unit}, {"value", h.value}, {"sigma", h.sigma}, {"wear", h.wear}});
  return json;
}

Json extremes_to_json(const std::vector<Flight::Extreme>& extremes) {
  Json json = Json::array();
  for (const auto& e : extremes)  // nothing was seen of what is infinite
    if (std::isfinite(e.least) && std::isfinite(e.greatest))
      json.push_back({{"name", e.name}, {"unit", e.unit}, {"least", e.least}, {"greatest", e.greatest}});
  return json;
}

/// `read(object)` for each of the array.
template <class Read>
void each(JsonObject& root, const std::string& key, Read&& read) {
  std::size_t i = 0;
  for (const Json& element : root.array(key)) {
    JsonObject object(element, root.file(), root.key(key) + "[" + std::to_string(i++) + "]");
    read(object);
    object.refuse_unknown();
  }
}

/// A channel without unit is written so.
std::string unit_of(JsonObject& object) {
  const Json& value = object.at("unit");
  if (!value.is_string()) files::throw_defect(object.file(), object.key("unit"), files::shown(value), "a text", remedy);
  return value.get<std::string>();
}

std::vector<Flight::Extreme> extremes_from_json(JsonObject& root, const std::string& key) {
  std::vector<Flight::Extreme> extremes;
  each(root, key, [&](JsonObject& o) {
    extremes.push_back({o.text("name"), unit_of(o), o.number("least"), o.number("greatest")});
  });
  return extremes;
}

std::int64_t time_of(JsonObject& root, const std::string& key) {
  return state_json::integer<std::int64_t>(root, key, std::numeric_limits<std::int64_t>::min(),
                                           std::numeric_limits<std::int64_t>::max());
}

Flight flight_from_json(JsonObject& root) {
  Flight f;
  f.number = state_json::integer<std::uint32_t>(root, "flight", 1, most_count);
  f.start_ns = time_of(root, "start_ns");
  f.landing_ns = time_of(root, "landing_ns");
  f.design_hash = root.text("design");
  f.samples = state_json::integer<std::uint64_t>(root, "samples", 0, std::numeric_limits<std::uint64_t>::max());
  f.estimated = state_json::integer<std::uint64_t>(root, "estimated", 0, std::numeric_limits<std::uint64_t>::max());
  f.flags = state_json::integer<std::uint32_t>(root, "flags", 0, most_count);
  f.events = state_json::integer<std::uint32_t>(root, "events", 0, most_count);
  f.exceedances = state_json::integer<std::uint32_t>(root, "exceedances", 0, most_count);
  f.flights_learned = state_json::integer<std::uint32_t>(root, "flights_learned", 0, most_count);
  JsonObject phases(root.at("phase_s"), root.file(), "phase_s");
  for (std::size_t i = 0; i < idl::flight_phase_names.size(); ++i)
    f.phase_s[i] = phases.number(idl::flight_phase_names[i]);
  phases.refuse_unknown();
  each(root, "health", [&](JsonObject& o) {
    f.health.push_back({o.text("name"), unit_of(o), o.number("value"), o.number("sigma"), o.number("wear")});
  });
  f.sensors = extremes_from_json(root, "sensors");
  f.auxiliary = extremes_from_json(root, "auxiliary");
  if (root.find("egt_margin_k"))
    f.margins = FlightMargins{root.number("egt_margin_k"), root.number("egt_margin_sigma_k"),
                              root.number("thrust_margin"), root.number("thrust_margin_sigma")};
  return f;
}

Maintenance maintenance_from_json(JsonObject& root, Maintenance::Kind kind) {
  Maintenance m{kind, time_of(root, "time_ns"), {}};
  if (root.find("note")) m.note = root.text("note");
  return m;
}

}  // namespace

const char* name_of(Maintenance::Kind kind) {
  return kind == Maintenance::Kind::wash ? "wash" : "replacement";
}

std::string to_line(const Flight& f) {
  Json phases = Json::object();
  for (std::size_t i = 0; i < idl::flight_phase_names.size(); ++i) phases[idl::flight_phase_names[i]] = f.phase_s[i];
  Json json = {{"schema", flight_schema},
               {"kind", "flight"},
               {"flight", f.number},
               {"start_ns", f.start_ns},
               {"landing_ns", f.landing_ns},
               {"design", f.design_hash},
               {"samples", f.samples},
               {"estimated", f.estimated},
               {"flags", f.flags},
               {"events", f.events},
               {"exceedances", f.exceedances},
               {"flights_learned", f.flights_learned},
               {"phase_s", phases},
               {"health", health_to_json(f.health)},
               {"sensors", extremes_to_json(f.sensors)},
               {"auxiliary", extremes_to_json(f.auxiliary)}};
  if (f.margins) {
    json["egt_margin_k"] = f.margins->egt_k;
    json["egt_margin_sigma_k"] = f.margins->egt_sigma_k;
    json["thrust_margin"] = f.margins->thrust;
    json["thrust_margin_sigma"] = f.margins->thrust_sigma;
  }
  return json.dump() + "\n";
}

std::string to_line(const Maintenance& m) {
  Json json = {{"schema", flight_schema}, {"kind", name_of(m.kind)}, {"time_ns", m.time_ns}};
  if (!m.note.empty()) json["note"] = m.note;
  return json.dump() + "\n";
}

HistoryEntry parse_line(std::string_view line, const std::string& where) {
  const Json json = files::parse_json_text(std::string(line), where);
  JsonObject root(json, where, "");
  if (const std::string schema = root.text("schema"); schema != flight_schema)
    files::throw_defect(where, "schema", schema, std::string("\"") + flight_schema + "\"", remedy);
  HistoryEntry entry;
  const std::string kind = root.text("kind");
  if (kind == "flight")
    entry.flight = flight_from_json(root);
  else if (kind == name_of(Maintenance::Kind::wash))
    entry.maintenance = maintenance_from_json(root, Maintenance::Kind::wash);
  else if (kind == name_of(Maintenance::Kind::replacement))
    entry.maintenance = maintenance_from_json(root, Maintenance::Kind::replacement);
  else
    files::throw_defect(where, "kind", kind, "flight, wash or replacement", remedy);
  root.refuse_unknown();
  return entry;
}

}  // namespace ehm::monitor
