// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/watch_output.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "deploy/demo/text_layout.h"
#include "idl/wire_names.h"

namespace ehm::demo {

namespace {

constexpr std::size_t event_lines = 6;
constexpr std::size_t line_rows = 3;  ///< of health and of auxiliary outputs that a line for a log has room for

/// Fractions read better in percent.
struct Shown {
  double factor;
  std::string unit;
};
Shown shown(const std::string& unit) {
  return unit == "fraction" ? Shown{100.0, "%"} : Shown{1.0, unit};
}

/// With as many decimals as show three digits of its sigma.
std::string number(double value, double sigma) {
  const bool usual = std::isfinite(sigma) && sigma > 0.0 && std::abs(value) < 1e9;
  if (!usual) return fmt::format("{:.4g}", value);
  return fmt::format("{:.{}f}", value, std::clamp(2 - static_cast<int>(std::floor(std::log10(sigma))), 0, 4));
}

std::vector<std::string> cells(const Row& row, bool with_truth) {
  const auto [factor, unit] = shown(row.unit);
  const double sigma = factor * row.sigma;
  std::vector<std::string> cells{row.name};
  if (with_truth) cells.push_back(row.truth ? number(factor * *row.truth, sigma) : "-");
  cells.push_back(number(factor * row.estimate, sigma));
  cells.push_back("+-" + number(sigma, sigma));
  cells.push_back(unit);
  if (with_truth) cells.push_back(row.truth ? fmt::format("{:.1f}", *row.deviation()) : "-");
  return cells;
}

std::string rows_text(const WatchData& data, int columns) {
  const auto health = data.health(), auxiliary = data.auxiliary();
  const auto has_truth = [](const Row& row) { return row.truth.has_value(); };
  const bool with_truth = std::any_of(health.begin(), health.end(), has_truth) ||
                          std::any_of(auxiliary.begin(), auxiliary.end(), has_truth);
  std::vector<std::vector<std::string>> lines;
  lines.push_back(with_truth ? std::vector<std::string>{"", "truth", "estimate", "+-sigma", "", "sigmas"}
                             : std::vector<std::string>{"", "estimate", "+-sigma", ""});
  for (const auto* rows : {&health, &auxiliary})
    for (const Row& row : *rows) lines.push_back(cells(row, with_truth));
  return columns_text(lines, with_truth ? "lrrrlr" : "lrrl", columns);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// "OK", or with the flags: "WARN: degraded shifted"
std::string state_text(const WatchData& data) {
  const std::string flags = joined(data.flags());
  const char* level = data.status() ? idl::level_name(data.status()->level()) : "waiting";
  return flags.empty() ? level : std::string(level) + ": " + flags;
}

std::string sensors_text(const WatchData& data) {
  const auto left_out = data.sensors(false);
  return "sensors in use: " + joined(data.sensors(true)) + (left_out.empty() ? "" : "; left out: " + joined(left_out));
}

/// The latency is what the monitor measures of itself: two clocks that nobody has set alike measure none.
std::string counts_text(const WatchData& data) {
  const MonitorStatus* status = data.status();
  std::string text;
  if (status)
    text = fmt::format("rate {:.1f}/s, latency p50 {:.0f} us, p99 {:.0f} us, max {:.0f} us; ", status->rate_hz(),
                       status->latency_p50_us(), status->latency_p99_us(), status->latency_max_us());
  text += fmt::format("estimates {}, lost {}, withheld {}", data.estimates(), data.lost(), data.withheld());
  if (const auto ignored = data.truth().ignored(); ignored > 0)
    text += fmt::format("; {} EngineTruth of others ignored", ignored);
  return text;
}

std::string event_text(const EventLine& event, int columns) {
  return wrapped(fmt::format("  {:7.2f} s {}: {}", event.time_s, event.raised ? "raised" : "cleared", event.message),
                 columns, 4);
}

std::string body_text(const WatchData& data, int columns) {
  return wrapped(fmt::format("{:.1f} s of flight, {}", data.flight_time_s(), state_text(data)), columns, 2) +
         wrapped(sensors_text(data), columns, 2) + "\n" + rows_text(data, columns) + "\n" +
         wrapped(counts_text(data), columns, 2);
}

/// Those farthest from nominal, in sigmas.
std::vector<Row> most_worn(std::vector<Row> rows) {
  const auto sigmas = [](const Row& row) { return row.sigma > 0.0 ? std::abs(row.estimate) / row.sigma : 0.0; };
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return sigmas(a) > sigmas(b); });
  return rows;
}

std::string short_text(const Row& row) {
  const auto [factor, unit] = shown(row.unit);
  const double sigma = factor * row.sigma;
  return fmt::format("; {} {} +-{} {}{}", row.name, number(factor * row.estimate, sigma), number(sigma, sigma), unit,
                     row.truth ? " (true " + number(factor * *row.truth, sigma) + ")" : "");
}

}  // namespace

std::string table(const WatchData& data, int columns) {
  std::string text = body_text(data, columns) + "\n";
  const auto& events = data.events();
  for (std::size_t i = events.size() > event_lines ? events.size() - event_lines : 0; i < events.size(); ++i)
    text += event_text(events[i], columns);
  std::string shown = "\033[H";
  for (const char c : text) shown += c == '\n' ? std::string("\033[K\n") : std::string(1, c);  // clears the line's rest
  return shown + "\033[J";
}

std::string line(const WatchData& data, int columns) {
  std::string text = fmt::format("{:6.1f} s {}", data.flight_time_s(), state_text(data));
  auto health = most_worn(data.health()), auxiliary = data.auxiliary();
  for (auto* rows : {&health, &auxiliary})
    for (std::size_t i = 0; i < std::min(rows->size(), line_rows); ++i) text += short_text((*rows)[i]);
  return wrapped(text + "; " + counts_text(data), columns, 4);
}

std::string summary(const WatchData& data, int columns) {
  std::string text = "\n" + body_text(data, columns);
  text += data.published() > 0 ? fmt::format("samples published {}, received {}\n", data.published(), data.received())
                               : fmt::format("samples received {}\n", data.received());
  if (!accuracy_judged(data))
    text += wrapped("accuracy was not judged: no EngineTruth of the engine's own source beside the last estimate",
                    columns, 2);
  if (data.events_dropped() > 0) text += std::to_string(data.events_dropped()) + " events before these\n";
  for (const auto& event : data.events()) text += event_text(event, columns);
  return text;
}

bool accuracy_judged(const WatchData& data) {
  const auto health = data.health();
  return !health.empty() && health.front().truth.has_value();
}

std::string verdict(const WatchData& data, double sigmas) {
  std::string text;
  const auto say = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  const auto health = data.health(), auxiliary = data.auxiliary();
  if (health.empty()) say("no estimate was heard together with its description");
  if (data.error_said()) say("the monitor said ERROR");
  if (data.withheld() > 0) say(fmt::format("{} samples were withheld from estimation", data.withheld()));
  if (data.lost() > 0)
    say(data.published() > 0 ? fmt::format("{} of {} samples were lost", data.lost(), data.published())
                             : fmt::format("{} samples were lost", data.lost()));
  if (data.published() > 0 && !health.empty() && !accuracy_judged(data))
    say("EngineTruth came, but none of the last estimate");
  for (const auto* rows : {&health, &auxiliary})
    for (const Row& row : *rows)
      if (!std::isfinite(row.estimate) || !(row.sigma > 0.0))
        say(row.name + " is no number with a sigma");
      else if (row.truth && *row.deviation() > sigmas)
        say(fmt::format("{} is {:.1f} published sigmas off", row.name, *row.deviation()));
  return text;
}

std::string ignored_truth(const WatchData& data, std::uint32_t engine_id) {
  // Descriptions come by another writer than truth, and may be a moment later.
  constexpr std::uint64_t told_from = 16;
  if (data.truth().ignored() < told_from) return {};
  if (data.truth().described())
    return fmt::format("EngineTruth of engine {} from another participant is ignored", engine_id);
  return fmt::format(
      "EngineTruth of engine {} is ignored: no participant describes the engine as its source (EngineDescription)",
      engine_id);
}

}  // namespace ehm::demo
