// SPDX-License-Identifier: Apache-2.0
#include "monitor/export/health_answer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include <spdlog/fmt/fmt.h>

namespace ehm::monitor {

namespace {

using idl::StatusLevel;
using nlohmann::json;
using service::HttpAnswer;

HttpAnswer answer(const json& body, bool good) {
  return {good ? 200 : 503, body.dump() + "\n", "application/json"};
}

json engines_at(const FleetView& fleet, StatusLevel level) {
  json ids = json::array();
  for (const auto& [id, engine] : fleet)
    if (engine.status_ns != 0 && engine.status.level() == static_cast<std::uint32_t>(level)) ids.push_back(id);
  return ids;
}

json engines_by_level(const FleetView& fleet) {
  json levels = json::object();
  for (const auto level :
       {StatusLevel::ok, StatusLevel::warn, StatusLevel::error, StatusLevel::stale, StatusLevel::stopped})
    levels[idl::level_name(static_cast<std::uint32_t>(level))] = engines_at(fleet, level);
  return levels;
}

double status_age_s(const EngineView& engine, const Ages& ages) {
  return 1e-9 * static_cast<double>(ages.now_ns - engine.status_ns);
}

/// Rounded to a millisecond: for people.
double rounded(double seconds) {
  return std::round(1e3 * seconds) / 1e3;
}

json stalled_loops(const Ages& ages) {
  json reasons = json::array();
  const auto check = [&](const char* loop, double age_s) {
    if (age_s > longest_turn_s) reasons.push_back(fmt::format("the {} thread has stalled for {:.1f} s", loop, age_s));
  };
  check("cycle", ages.cycle_s);
  check("reporter", ages.reporter_s);
  return reasons;
}

json loop_ages(const Ages& ages) {
  return {{"cycle", rounded(ages.cycle_s)}, {"reporter", rounded(ages.reporter_s)}};
}

}  // namespace

HttpAnswer health_answer(const FleetView& fleet, const Ages& ages) {
  const json reasons = stalled_loops(ages);
  return answer({{"healthy", reasons.empty()},
                 {"reasons", reasons},
                 {"loop_age_s", loop_ages(ages)},
                 {"engines", engines_by_level(fleet)}},
                reasons.empty());
}

HttpAnswer ready_answer(const FleetView& fleet, const Ages& ages) {
  json reasons = stalled_loops(ages);
  const json stale = engines_at(fleet, StatusLevel::stale), error = engines_at(fleet, StatusLevel::error);
  json old = json::array();
  double oldest_s = 0.0;
  bool heard = false;
  for (const auto& [id, engine] : fleet) {
    if (engine.status_ns == 0) continue;
    heard = true;
    const double age_s = status_age_s(engine, ages);
    oldest_s = std::max(oldest_s, age_s);
    if (age_s > ages.status_limit_s) old.push_back(id);
  }
  if (!heard) reasons.push_back("no engine has been heard");
  if (!old.empty())
    reasons.push_back(fmt::format("the status of engines {} is up to {:.1f} s old, it is due every {:.1f} s",
                                  old.dump(), oldest_s, ages.status_limit_s));
  if (!stale.empty()) reasons.push_back("no input from engines " + stale.dump());
  if (!error.empty()) reasons.push_back("no estimate can be made for engines " + error.dump());
  return answer({{"ready", reasons.empty()},
                 {"reasons", reasons},
                 {"loop_age_s", loop_ages(ages)},
                 {"oldest_status_s", rounded(oldest_s)},
                 {"engines", engines_by_level(fleet)}},
                reasons.empty());
}

}  // namespace ehm::monitor
