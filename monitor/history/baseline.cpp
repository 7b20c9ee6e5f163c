// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/baseline.h"

#include <limits>
#include <utility>

#include "deploy/runtime/numbers/index.h"
#include "monitor/checkpoint/state_json.h"

namespace ehm::monitor {

namespace {

using files::Json;
using files::JsonObject;

std::vector<std::string> names_from_json(JsonObject& root) {
  const Json& array = root.array("names");
  if (array.empty() || array.size() > as_size(estimation::max_learned))
    state_json::defect(root, "names", array.size(), "1 to " + std::to_string(estimation::max_learned) + " names");
  std::vector<std::string> names;
  for (const Json& name : array) {
    if (!name.is_string()) state_json::defect(root, "names", name, "names");
    names.push_back(name.get<std::string>());
  }
  return names;
}

}  // namespace

std::string to_text(const Baseline& b) {
  return state_json::hashed_text({{"schema", baseline_schema},
                                  {"engine_id", b.engine_id},
                                  {"engine_type", b.engine_type},
                                  {"names", b.names},
                                  {"flights", b.flights},
                                  {"flights_of_first", b.flights_of_first},
                                  {"landing_ns", b.landing_ns},
                                  {"first", state_json::learned_to_json(b.first, "baseline", "first")},
                                  {"latest", state_json::learned_to_json(b.latest, "baseline", "latest")}});
}

Baseline parse_baseline(std::string_view text, const std::string& file) {
  constexpr auto most = std::numeric_limits<std::uint32_t>::max();
  const Json json = files::parse_json_text(std::string(text), file);
  JsonObject root(json, file, "");
  if (const std::string schema = root.text("schema"); schema != baseline_schema)
    state_json::defect(root, "schema", schema, std::string("\"") + baseline_schema + "\"");
  state_json::require_hash(root, json);
  Baseline b;
  b.engine_id = state_json::integer<std::uint32_t>(root, "engine_id", 1, most);
  b.engine_type = root.text("engine_type");
  b.names = names_from_json(root);
  b.flights = state_json::integer<std::uint32_t>(root, "flights", 1, most);
  b.flights_of_first = state_json::integer<std::uint32_t>(root, "flights_of_first", 1, b.flights);
  b.landing_ns = state_json::integer<std::int64_t>(root, "landing_ns", std::numeric_limits<std::int64_t>::min(),
                                                   std::numeric_limits<std::int64_t>::max());
  b.first = state_json::learned_from_json(root, "first", as_index(b.names.size()));
  b.latest = state_json::learned_from_json(root, "latest", as_index(b.names.size()));
  root.refuse_unknown();
  return b;
}

void count_flight(Baseline& baseline, const estimation::Learned& learned, std::int64_t landing_ns,
                  std::uint32_t first_flights) {
  ++baseline.flights;
  baseline.latest = learned;
  baseline.landing_ns = landing_ns;
  if (baseline.flights > first_flights && !baseline.first.empty()) return;
  baseline.first = learned;
  baseline.flights_of_first = baseline.flights;
}

}  // namespace ehm::monitor
