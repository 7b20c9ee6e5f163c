#include "monitor/export/health_answer.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <thread>

namespace ehm::monitor {

namespace {

using nlohmann::json;
using service::HttpAnswer;
using wire::StatusLevel;

constexpr int looks = 40;
constexpr std::chrono::milliseconds between_looks{5};

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
    levels[wire::level_name(static_cast<std::uint32_t>(level))] = engines_at(fleet, level);
  return levels;
}

}  // namespace

HttpAnswer health_answer(const FleetView& fleet, const Loops& loops) {
  const std::uint64_t cycle = loops.cycle.turns(), reporter = loops.reporter.turns();
  bool cycle_turns = false, reporter_turns = false;
  for (int look = 0; look < looks && !(cycle_turns && reporter_turns); ++look) {
    std::this_thread::sleep_for(between_looks);
    cycle_turns = loops.cycle.turns() != cycle;
    reporter_turns = loops.reporter.turns() != reporter;
  }
  json reasons = json::array();
  if (!cycle_turns) reasons.push_back("the cycle thread has stalled");
  if (!reporter_turns) reasons.push_back("the reporter thread has stalled");
  return answer({{"healthy", reasons.empty()}, {"reasons", reasons}, {"engines", engines_by_level(fleet)}},
                reasons.empty());
}

HttpAnswer ready_answer(const FleetView& fleet) {
  json reasons = json::array();
  const json stale = engines_at(fleet, StatusLevel::stale), error = engines_at(fleet, StatusLevel::error);
  const bool heard = std::any_of(fleet.begin(), fleet.end(), [](const auto& e) { return e.second.status_ns != 0; });
  if (!heard) reasons.push_back("no engine has been heard");
  if (!stale.empty()) reasons.push_back("no input from engines " + stale.dump());
  if (!error.empty()) reasons.push_back("no estimate can be made for engines " + error.dump());
  return answer({{"ready", reasons.empty()}, {"reasons", reasons}, {"engines", engines_by_level(fleet)}},
                reasons.empty());
}

}  // namespace ehm::monitor
