// SPDX-License-Identifier: Apache-2.0
// How many engines one monitor serves: fleets of growing size from a light replayer before a real monitor, with a
// subscriber of the estimates. Prints loss, latency, processor time and resident memory, and what one more engine takes of
// both by a linear fit; --largest then doubles and bisects up to the largest fleet without loss and with its p99 within
// one period.
//
// Usage: fleet_bench --design FILE [--sizes 1,10,50] [--seconds 10] [--estimator onboard] [--largest] [--loss-only] [--domain 45]
// Exit:  0 no loss in the sizes asked for and p99 within 3 ms, 1 not, 2 wrong usage

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <vector>

#include "deploy/runtime/config/usage_answer.h"
#include "tests/bench/fleet_run.h"

namespace {

using namespace ehm::tuner_design;

constexpr double asked_p99_us = 3000.0;
constexpr std::uint32_t most_engines = 1000;  ///< monitor.max_engines allows no more

FleetResult fly_and_print(FleetOptions options, std::uint32_t engines) {
  options.engines = engines;
  const FleetResult r = fly_fleet(options);
  fmt::print("{:>7}{:>10}{:>11}{:>7}{:>7}{:>10.0f}{:>10.0f}{:>10.0f}{:>9.1f}{:>13.3f}{:>10.1f}\n", r.engines, r.sent,
             r.estimates, r.lost, r.late, r.p50_us, r.p99_us, r.max_us, r.cpu_percent, r.cpu_percent_per_engine(),
             r.memory_mb);
  std::fflush(stdout);
  return r;
}

/// Least squares of a figure over the number of engines: fixed + each * engines, and the share of the variance that it
/// explains; nothing where the sizes do not tell.
void print_fit(const std::vector<FleetResult>& results, const char* name, const char* unit, int digits,
               double (*figure)(const FleetResult&)) {
  const auto n = static_cast<double>(results.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (const auto& r : results) {
    const double x = r.engines, y = figure(r);
    sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
  }
  const double vx = sxx - sx * sx / n, vy = syy - sy * sy / n, vxy = sxy - sx * sy / n;
  if (results.size() < 3 || vx <= 0.0 || vy <= 0.0) return;
  const double each = vxy / vx;
  fmt::print("{0} = {3:.{2}f} {1} + {4:.{2}f} {1} per engine, R^2 = {5:.4f}\n", name, unit, digits,
             (sy - each * sx) / n, each, vxy * vxy / (vx * vy));
}

/// The largest fleet that this host carries, known to lie above `carried`.
std::uint32_t largest(const FleetOptions& options, std::uint32_t carried) {
  const auto carries = [&](std::uint32_t engines) {
    const FleetResult r = fly_and_print(options, engines);
    return r.lossless() && r.p99_us < 1e3 * options.period_ms;
  };
  std::uint32_t too_many = most_engines + 1;
  while (carried < most_engines && too_many > most_engines) {
    const std::uint32_t next = std::min(2 * carried, most_engines);
    (carries(next) ? carried : too_many) = next;
  }
  while (too_many - carried > std::max(10u, carried / 20)) {
    const std::uint32_t next = (carried + too_many) / 2;
    (carries(next) ? carried : too_many) = next;
  }
  return carried;
}

}  // namespace

int main(int argc, char** argv) {
  FleetOptions options;
  std::vector<std::uint32_t> sizes{1, 10, 50};
  bool find_largest = false, loss_only = false;
  CLI::App app{"How many engines one monitor serves"};
  app.add_option("--design", options.design, "design file of the monitor")->required()->check(CLI::ExistingFile);
  app.add_option("--estimator", options.estimator, "that the monitor publishes");
  app.add_option("--sizes", sizes, "engines of each run")->delimiter(',')->check(CLI::Range(1u, most_engines));
  app.add_option("--seconds", options.seconds, "of each run")->check(CLI::Range(1.0, 86400.0));
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 232));
  app.add_flag("--loss-only", loss_only, "judge loss, not latency: for a machine that does other work too");
  app.add_flag("--largest", find_largest, "look for the largest fleet that this host carries");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ehm::config::usage_answer(app, e);
  }
  try {
    fmt::print("{:>7}{:>10}{:>11}{:>7}{:>7}{:>10}{:>10}{:>10}{:>9}{:>13}{:>10}\n", "engines", "sent", "estimates",
               "lost", "late", "p50 us", "p99 us", "max us", "cpu %", "cpu %/engine", "RSS MB");
    std::vector<FleetResult> results;
    bool good = true;
    for (const std::uint32_t engines : sizes) {
      results.push_back(fly_and_print(options, engines));
      good = good && results.back().lossless() && (loss_only || results.back().p99_us < asked_p99_us);
    }
    print_fit(results, "cpu", "%", 3, [](const FleetResult& r) { return r.cpu_percent; });
    print_fit(results, "memory", "kB", 0, [](const FleetResult& r) { return 1e3 * r.memory_mb; });
    if (find_largest)
      fmt::print("largest fleet that this host carries without loss, p99 within {:.0f} ms: {} engines\n",
                 options.period_ms, largest(options, results.back().engines));
    return good ? 0 : 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "fleet_bench: {}\n", e.what());
    return 1;
  }
}
