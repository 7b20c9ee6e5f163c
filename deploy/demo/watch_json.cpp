// SPDX-License-Identifier: Apache-2.0
// The summary as one JSON object.

#include <nlohmann/json.hpp>

#include "deploy/demo/watch_output.h"
#include "idl/wire_names.h"

namespace ehm::demo {

namespace {

using Json = nlohmann::ordered_json;

Json rows_json(const std::vector<Row>& rows) {
  Json array = Json::array();
  for (const Row& row : rows) {
    Json entry{{"name", row.name}, {"unit", row.unit}};
    if (row.truth) entry["truth"] = *row.truth;
    entry["estimate"] = row.estimate;
    entry["sigma"] = row.sigma;
    array.push_back(std::move(entry));
  }
  return array;
}

Json events_json(const WatchData& data) {
  Json array = Json::array();
  for (const auto& event : data.events())
    array.push_back({{"time_s", event.time_s},
                     {"kind", event.kind},
                     {"raised", event.raised},
                     {"channel", event.channel},
                     {"value", event.value},
                     {"message", event.message}});
  return array;
}

}  // namespace

std::string json(const WatchData& data) {
  Json j;
  if (data.published() > 0) j["samples_published"] = data.published();
  j["samples_received"] = data.received();
  j["samples_lost"] = data.lost();
  j["samples_withheld"] = data.withheld();
  j["truth_ignored"] = data.truth().ignored();
  j["accuracy_judged"] = accuracy_judged(data);
  if (const MonitorStatus* status = data.status()) {
    j["level"] = idl::level_name(status->level());
    j["latency_us"] = {
        {"p50", status->latency_p50_us()}, {"p99", status->latency_p99_us()}, {"max", status->latency_max_us()}};
  }
  j["flags"] = data.flags();
  j["sensors_used"] = data.sensors(true);
  j["sensors_left_out"] = data.sensors(false);
  j["health"] = rows_json(data.health());
  j["auxiliary"] = rows_json(data.auxiliary());
  j["events_dropped"] = data.events_dropped();
  j["events"] = events_json(data);
  return j.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace ehm::demo
