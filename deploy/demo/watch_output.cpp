#include "deploy/demo/watch_output.h"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>

#include "idl/wire_names.h"

namespace ehm::demo {

namespace {

constexpr std::size_t event_lines = 6;

/// Fractions read better in percent.
struct Shown {
  double factor;
  std::string unit;
};
Shown shown(const std::string& unit) {
  return unit == "fraction" ? Shown{100.0, "%"} : Shown{1.0, unit};
}

std::string row_text(const Row& row) {
  const auto [factor, unit] = shown(row.unit);
  return fmt::format("  {:<16}{:>12.3f}{:>12.3f} +-{:>9.3f}  {:<8}{:>6.1f}", row.name, factor * row.truth,
                     factor * row.estimate, factor * row.sigma, unit, row.deviation());
}

std::string rows_text(const WatchData& data, const char* line_end) {
  std::string text = fmt::format("  {:<16}{:>12}{:>12} +-{:>9}  {:<8}{:>6}{}", "", "truth", "estimate", "sigma", "",
                                 "sigmas", line_end);
  for (const auto& row : data.health()) text += row_text(row) + line_end;
  for (const auto& row : data.auxiliary()) text += row_text(row) + line_end;
  return text;
}

std::string counts_text(const WatchData& data) {
  const auto& status = data.status();
  return fmt::format("rate {:.1f}/s  latency p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us  estimates {}  lost {}",
                     status ? status->rate_hz() : 0.0, data.latency().percentile_us(0.5),
                     data.latency().percentile_us(0.99), data.latency().max_us(), data.estimates(), data.lost());
}

std::string event_text(const EventLine& event) {
  return fmt::format("  {:7.2f} s  {}  {}", event.time_s, event.raised ? "raised " : "cleared", event.message);
}

}  // namespace

std::string table(const WatchData& data) {
  constexpr const char* line_end = "\033[K\n";  // clears what the last table left on the line
  std::string text = fmt::format("\033[H{:.1f} s of flight   {}{}{}{}", data.flight_time_s(),
                                 data.status() ? wire::level_name(data.status()->level()) : "waiting", line_end,
                                 rows_text(data, line_end), line_end);
  text += "  " + counts_text(data) + line_end + line_end;
  const auto& events = data.events();
  for (std::size_t i = events.size() > event_lines ? events.size() - event_lines : 0; i < events.size(); ++i)
    text += event_text(events[i]) + line_end;
  return text + "\033[J";
}

std::string line(const WatchData& data) {
  std::string text = fmt::format("{:6.1f} s  {:<7}", data.flight_time_s(),
                                 data.status() ? wire::level_name(data.status()->level()) : "waiting");
  for (const auto& row : data.health())
    if (row.name.find("hpc") != std::string::npos)
      text += fmt::format("  {} {:+.2f} % (true {:+.2f})", row.name, 100.0 * row.estimate, 100.0 * row.truth);
  for (const auto& row : data.auxiliary())
    text += fmt::format("  {} {:.1f} (true {:.1f})", row.name, row.estimate, row.truth);
  return text + "  " + counts_text(data) + "\n";
}

std::string summary(const WatchData& data) {
  std::string text = "\n" + rows_text(data, "\n") + "\n";
  text += fmt::format("  samples published {}, received {}, lost {}\n  {}\n", data.published(), data.received(),
                      data.lost(), counts_text(data));
  if (data.events_dropped() > 0) text += std::to_string(data.events_dropped()) + " events before these\n";
  for (const auto& event : data.events()) text += event_text(event) + "\n";
  return text;
}

std::string json(const WatchData& data) {
  nlohmann::ordered_json j;
  j["samples_published"] = data.published();
  j["samples_received"] = data.received();
  j["samples_lost"] = data.lost();
  j["latency_us"] = {{"p50", data.latency().percentile_us(0.5)},
                     {"p99", data.latency().percentile_us(0.99)},
                     {"max", data.latency().max_us()}};
  j["health"] = nlohmann::ordered_json::array();
  for (const auto& row : data.health())
    j["health"].push_back({{"name", row.name}, {"truth", row.truth}, {"estimate", row.estimate}, {"sigma", row.sigma}});
  j["auxiliary"] = nlohmann::ordered_json::array();
  for (const auto& row : data.auxiliary())
    j["auxiliary"].push_back({{"name", row.name},
                              {"unit", row.unit},
                              {"truth", row.truth},
                              {"estimate", row.estimate},
                              {"sigma", row.sigma}});
  j["events_dropped"] = data.events_dropped();
  j["events"] = nlohmann::ordered_json::array();
  for (const auto& event : data.events())
    j["events"].push_back({{"time_s", event.time_s},
                           {"kind", event.kind},
                           {"raised", event.raised},
                           {"channel", event.channel},
                           {"value", event.value},
                           {"message", event.message}});
  return j.dump(2) + "\n";
}

std::string verdict(const WatchData& data, double sigmas) {
  const auto health = data.health(), auxiliary = data.auxiliary();
  if (health.empty()) return "no estimate was heard together with its truth and its description";
  std::string text;
  const auto say = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (data.lost() > 0) say(fmt::format("{} of {} samples were lost", data.lost(), data.published()));
  for (const auto* rows : {&health, &auxiliary})
    for (const auto& row : *rows)
      if (row.deviation() > sigmas) say(fmt::format("{} is {:.1f} published sigmas off", row.name, row.deviation()));
  return text;
}

}  // namespace ehm::demo
