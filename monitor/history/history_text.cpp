// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/history_text.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "idl/wire_names.h"
#include "monitor/history/history_trend.h"

namespace ehm::monitor {

namespace {

constexpr double soon_flights = 100.0;  // a limit nearer than so many flights is due

std::string utc(std::int64_t time_ns) {
  return fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(static_cast<std::time_t>(time_ns / 1'000'000'000)));
}

double airborne_s(const Flight& f) {
  double sum_s = 0.0;
  for (std::size_t i = static_cast<std::size_t>(idl::FlightPhase::take_off); i < f.phase_s.size(); ++i)
    sum_s += f.phase_s[i];
  return sum_s;
}

double estimated_percent(const Flight& f) {
  return f.samples == 0 ? 0.0 : 100.0 * static_cast<double>(f.estimated) / static_cast<double>(f.samples);
}

/// While its build is being learned there is nothing that wear could be counted from.
bool wear_known(const Flight& f) {
  return f.flights_learned > 0 && f.number > f.flights_learned;
}

/// The parameter that has worn most; null where nothing is known.
const Flight::Health* most_worn(const Flight& f) {
  if (!wear_known(f)) return nullptr;
  const auto it =
      std::min_element(f.health.begin(), f.health.end(), [](const auto& a, const auto& b) { return a.wear < b.wear; });
  return it == f.health.end() ? nullptr : &*it;
}

std::string margin_cells(const Flight& f) {
  if (!f.margins) return fmt::format("{:>16} {:>9}", "-", "-");
  return fmt::format("{:>8.1f} +- {:<4.1f} {:>8.1f}%", f.margins->egt_k, f.margins->egt_sigma_k,
                     100.0 * f.margins->thrust);
}

std::string row(const Flight& f) {
  const Flight::Health* worn = most_worn(f);
  return fmt::format("{:>6}  {:<16} {:>8.0f} {:>6.1f} {} {:>7} {:>6}  {}\n", f.number, utc(f.landing_ns), airborne_s(f),
                     estimated_percent(f), margin_cells(f), f.events, f.exceedances,
                     worn ? fmt::format("{} {:+.2f} %", worn->name, 100.0 * worn->wear) : "-");
}

/// The margin of each flight as a line of marks between least and most; what was done on the ground between them.
std::string plot(const std::vector<HistoryEntry>& entries, double limit_k) {
  constexpr int width = 60;
  constexpr std::size_t most_lines = 60;
  double least = limit_k, most = limit_k;
  std::size_t flights = 0;
  for (const HistoryEntry& e : entries) {
    if (!e.flight || !e.flight->margins) continue;
    ++flights;
    least = std::min(least, e.flight->margins->egt_k - e.flight->margins->egt_sigma_k);
    most = std::max(most, e.flight->margins->egt_k + e.flight->margins->egt_sigma_k);
  }
  if (flights == 0 || most == least) return {};
  const auto column = [&](double k) {
    return static_cast<std::size_t>(std::clamp(std::lround((k - least) / (most - least) * width), 0l, long{width}));
  };
  std::string text = fmt::format("\nEGT margin, K: {:.1f} to {:.1f}; | the limit {:.1f}, = one sigma, * the margin\n",
                                 least, most, limit_k);
  const std::size_t every = (flights + most_lines - 1) / most_lines;
  std::size_t number = 0;
  for (const HistoryEntry& e : entries) {
    if (e.maintenance) text += fmt::format("        -- {} {}\n", name_of(e.maintenance->kind), e.maintenance->note);
    if (!e.flight || !e.flight->margins || number++ % every != 0) continue;
    const FlightMargins& m = *e.flight->margins;
    std::string line(width + 1, ' ');
    line[column(limit_k)] = '|';
    for (std::size_t i = column(m.egt_k - m.egt_sigma_k); i <= column(m.egt_k + m.egt_sigma_k); ++i) line[i] = '=';
    line[column(m.egt_k)] = '*';
    text += fmt::format("{:>6}  {}\n", e.flight->number, line.substr(0, line.find_last_not_of(' ') + 1));
  }
  return text;
}

std::string outlook(const std::vector<HistoryEntry>& entries, double limit_k) {
  std::string text = "\n";
  for (const Recovery& r : recoveries(entries))
    text += fmt::format("{} after flight {}: EGT margin {:+.1f} K\n", name_of(r.kind), r.after_flight, r.gained_k);
  const auto trend = margin_trend(entries, limit_k);
  if (!trend)
    return text + "no trend: it takes three flights with margins since the latest maintenance (estimator onboard)\n";
  text += fmt::format("EGT margin {:.1f} +- {:.1f} K, {:+.3f} +- {:.3f} K a flight over {} flights\n", trend->margin_k,
                      trend->sigma_k, trend->per_flight_k, trend->per_flight_sigma_k, trend->flights);
  if (trend->a_k <= limit_k) return text + fmt::format("due: the margin is at its limit of {:.1f} K\n", limit_k);
  // Where even the steepest fall that the scatter allows comes to nothing there is no limit in sight.
  if (!trend->left_least) return text + "due: nothing, the margin does not fall\n";
  const auto count = [](const std::optional<double>& n) { return n ? fmt::format("{:.0f}", *n) : "no end"; };
  text += fmt::format("limit of {:.1f} K in {} flights (95 %: {} to {})\n", limit_k, count(trend->left),
                      count(trend->left_least), count(trend->left_most));
  const bool soon = *trend->left_least < soon_flights;
  return text + (soon ? "due: a washing or an inspection, the limit may be near\n" : "due: nothing\n");
}

}  // namespace

std::string flight_line(const Flight& f) {
  std::string text =
      fmt::format("flight {} has landed: {:.0f} s in the air, estimates in {:.1f} % of the samples, {} events",
                  f.number, airborne_s(f), estimated_percent(f), f.events);
  if (f.exceedances > 0) text += fmt::format(", {} of them limits exceeded", f.exceedances);
  if (f.margins)
    text += fmt::format(", EGT margin {:.1f} +- {:.1f} K, thrust margin {:.1f} +- {:.1f} %", f.margins->egt_k,
                        f.margins->egt_sigma_k, 100.0 * f.margins->thrust, 100.0 * f.margins->thrust_sigma);
  return text;
}

std::string flight_text(const Flight& f) {
  std::string text = flight_line(f) + "\n\nphases:";
  for (std::size_t i = 1; i < idl::flight_phase_names.size(); ++i)
    if (f.phase_s[i] > 0.0) text += fmt::format("  {} {:.0f} s", idl::flight_phase_names[i], f.phase_s[i]);
  text += fmt::format("\n\n{:<20} {:>10} {:>10}{}\n", "health, percent", "estimate", "sigma",
                      wear_known(f) ? fmt::format(" {:>10}   since flights 1 to {}", "wear", f.flights_learned) : "");
  for (const auto& h : f.health)
    text += fmt::format("{:<20} {:>10.2f} {:>10.2f}{}\n", h.name, 100.0 * h.value, 100.0 * h.sigma,
                        wear_known(f) ? fmt::format(" {:>10.2f}", 100.0 * h.wear) : "");
  text += fmt::format("\n{:<20} {:>10} {:>10}\n", "in the air", "least", "greatest");
  for (const auto& e : f.auxiliary)
    text += fmt::format("{:<20} {:>10.1f} {:>10.1f} {}\n", e.name, e.least, e.greatest, e.unit);
  for (const auto& e : f.sensors)
    if (std::isfinite(e.greatest)) text += fmt::format("{:<20} {:>10} {:>10.1f} {}\n", e.name, "", e.greatest, e.unit);
  return text;
}

std::string history_text(std::uint32_t engine_id, const FlightHistory& history, double limit_k) {
  if (history.entries.empty()) return fmt::format("engine {}: no flight has been noted\n", engine_id);
  std::string text =
      fmt::format("engine {}\n{:>6}  {:<16} {:>8} {:>6} {:>16} {:>9} {:>7} {:>6}  {}\n", engine_id, "flight",
                  "landed (UTC)", "air s", "est %", "EGT margin K", "thrust", "events", "limits", "most worn");
  for (const HistoryEntry& e : history.entries)
    text += e.flight ? row(*e.flight)
                     : fmt::format("        -- {} {} {}\n", name_of(e.maintenance->kind), utc(e.maintenance->time_ns),
                                   e.maintenance->note);
  if (!history.torn.empty()) text += "the last line is incomplete and left out: " + history.torn + "\n";
  return text + plot(history.entries, limit_k) + outlook(history.entries, limit_k);
}

}  // namespace ehm::monitor
