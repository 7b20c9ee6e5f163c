// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/history_trend.h"

#include <algorithm>
#include <cmath>

namespace ehm::monitor {

namespace {

struct Point {
  double flight, margin_k;
};

/// Those with margins since the latest maintenance.
std::vector<const Flight*> latest_flights(const std::vector<HistoryEntry>& entries) {
  std::vector<const Flight*> flights;
  for (const HistoryEntry& entry : entries) {
    if (entry.maintenance) flights.clear();
    if (entry.flight && entry.flight->margins) flights.push_back(&*entry.flight);
  }
  return flights;
}

void count_left(MarginTrend& trend, double limit_k) {
  const double above_k = trend.a_k - limit_k;
  const auto until = [&](double per_flight_k) -> std::optional<double> {
    if (per_flight_k >= 0.0) return std::nullopt;
    return std::max(0.0, above_k / -per_flight_k);
  };
  constexpr double confidence = 1.96;
  trend.left = until(trend.per_flight_k);
  trend.left_least = until(trend.per_flight_k - confidence * trend.per_flight_sigma_k);
  trend.left_most = until(trend.per_flight_k + confidence * trend.per_flight_sigma_k);
}

}  // namespace

std::optional<MarginTrend> margin_trend(const std::vector<HistoryEntry>& entries, double limit_k) {
  const std::vector<const Flight*> flights = latest_flights(entries);
  if (flights.size() < 3) return std::nullopt;
  const double n = static_cast<double>(flights.size()), last = flights.back()->number;
  double mean_x = 0.0, mean_y = 0.0;
  for (const Flight* f : flights) {
    mean_x += (f->number - last) / n;
    mean_y += f->margins->egt_k / n;
  }
  double xx = 0.0, xy = 0.0;
  for (const Flight* f : flights) {
    const double x = f->number - last - mean_x;
    xx += x * x;
    xy += x * (f->margins->egt_k - mean_y);
  }
  if (xx == 0.0) return std::nullopt;
  MarginTrend trend;
  trend.flights = flights.size();
  trend.margin_k = flights.back()->margins->egt_k;
  trend.sigma_k = flights.back()->margins->egt_sigma_k;
  trend.per_flight_k = xy / xx;
  trend.a_k = mean_y - trend.per_flight_k * mean_x;
  double scatter = 0.0;
  for (const Flight* f : flights) {
    const double off = f->margins->egt_k - trend.a_k - trend.per_flight_k * (f->number - last);
    scatter += off * off;
  }
  trend.per_flight_sigma_k = std::sqrt(scatter / (n - 2.0) / xx);
  count_left(trend, limit_k);
  return trend;
}

std::vector<Recovery> recoveries(const std::vector<HistoryEntry>& entries) {
  std::vector<Recovery> all;
  const Flight* before = nullptr;
  std::optional<Maintenance::Kind> done;
  for (const HistoryEntry& entry : entries) {
    if (entry.maintenance) done = entry.maintenance->kind;
    if (!entry.flight || !entry.flight->margins) continue;
    if (done && before) all.push_back({*done, before->number, entry.flight->margins->egt_k - before->margins->egt_k});
    done.reset();
    before = &*entry.flight;
  }
  return all;
}

}  // namespace ehm::monitor
