// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/solve/steady.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/model/solve/steady_newton.h"

namespace ehm::engine_sim {
namespace {

using namespace steady;

constexpr double start_of_design_n1 = 0.9;  ///< corrected: a calm part of every map
constexpr double first_n1_step = 0.01;      ///< relative
constexpr double longest_step = 0.15;       ///< along the operating line, in units of `size`
constexpr int most_steps = 500;
constexpr int patience = 40;  ///< steps without coming nearer to the demand
/// What counts as a step of one in each unknown.
constexpr Unknowns size{5.0, 1.0, 1.0, 1.0, 1.0, 2.0, 1.0, 1.0, 1.0};
constexpr double lowest_of_design_n1 = 0.12, highest_of_design_n1 = 1.45;

void require_valid(const Demand& demand) {
  const bool positive = demand.kind == DemandKind::net_thrust_n || demand.value > 0.0;
  if (std::isfinite(demand.value) && positive) return;
  throw std::invalid_argument("steady: demand " + std::string(demand_names[as_size(demand.kind)]) + " = " +
                              std::to_string(demand.value) + " must be finite" +
                              (demand.kind == DemandKind::net_thrust_n ? "" : " and above zero"));
}

/// Health, geometry and off-take on the straight line from a to b; flight of b.
Operation between(const Operation& a, const Operation& b, double share) {
  const auto mean = [share](double from, double to) { return from + share * (to - from); };
  Operation o = b;
  for (std::size_t i = 0; i < health_count; ++i) o.health[i] = mean(a.health[i], b.health[i]);
  o.geometry = {mean(a.geometry.vsv_deg, b.geometry.vsv_deg), mean(a.geometry.vbv_fraction, b.geometry.vbv_fraction),
                mean(a.geometry.core_nozzle_area_ratio, b.geometry.core_nozzle_area_ratio)};
  o.offtake = {mean(a.offtake.customer_bleed_kg_s, b.offtake.customer_bleed_kg_s),
               mean(a.offtake.power_w, b.offtake.power_w)};
  return o;
}

/// Approaches one target from far, in steps each of which Newton's method manages.
class Approach {
 public:
  Approach(const Turbofan& engine, const Target& target) : engine_(engine), target_(target) {}

  Solution run() {
    Solution at = wear(nominal());
    at = along_the_operating_line(at);
    at.iterations = iterations_;
    return at;
  }

 private:
  Solution solve(const Operation& operation, const Demand& demand, const Unknowns& x) {
    Solution s = solve_at(engine_, {operation, demand}, x);
    iterations_ += s.iterations;
    return s;
  }
  std::optional<Solution> attempt(const Operation& operation, const Demand& demand, const Unknowns& x) {
    try {
      return solve(operation, demand, x);
    } catch (const SolveError&) {
      return std::nullopt;
    }
  }
  Demand n1_demand(double of_design) const {
    return {DemandKind::n1_rpm, of_design * engine_.data().design.speeds.n1_rpm};
  }

  /// New engine on schedule and without off-take, at the target's flight condition.
  Solution nominal() {
    Unknowns x = cold_start(engine_, target_.operation.flight);
    const Demand start = n1_demand(start_of_design_n1 * x[n1]);
    x[n1] *= start_of_design_n1;
    return solve(Operation{.flight = target_.operation.flight}, start, x);
  }

  /// To the target's health, geometry and off-take at constant fan speed; a failed step is halved, a good one doubled.
  Solution wear(Solution at) {
    const Operation from{.flight = target_.operation.flight};
    const Demand held = n1_demand(at.x[n1]);
    double share = 0.0, step = 0.5;
    while (share < 1.0) {
      const double next = std::min(1.0, share + step);
      if (const auto s = attempt(between(from, target_.operation, next), held, at.x)) {
        at = *s;
        share = next;
        step *= 2.0;
      } else if ((step *= 0.5) < 1e-3) {
        return solve(between(from, target_.operation, next), held, at.x);  // fails, and says which balance
      }
    }
    return at;
  }

  double excess(const Solution& s) const {
    return demanded_value(engine_, s.gas, target_.demand.kind) - target_.demand.value;
  }

  /// Steps along the operating line until the demand is passed; then from there. The first step is one of fan speed,
  /// with which every demanded quantity rises on a calm part of the line; the others follow the line wherever it turns.
  Solution along_the_operating_line(Solution at) {
    if (const auto s = attempt(target_.operation, target_.demand, at.x)) return *s;
    const double first = excess(at) < 0.0 ? first_n1_step : -first_n1_step;
    Solution before = at;
    at = solve(target_.operation, n1_demand(at.x[n1] * (1.0 + first)), at.x);
    Solution nearest = at;
    double length = 2.0;  // of the last step
    for (int step = 0, vain = 0; step < most_steps && vain < patience && on_the_map(at); ++step) {
      if (excess(before) * excess(at) <= 0.0) return bisect(before, at);
      const auto next = step_beyond(before, at, length);
      if (next) {
        before = at;
        at = *next;
        length = distance(before, at) < longest_step ? 1.5 : 1.0;
        const bool nearer = std::abs(excess(at)) < std::abs(excess(nearest));
        if (nearer) nearest = at;
        vain = nearer ? 0 : vain + 1;
      } else if ((length *= 0.4) < 1e-4) {
        break;
      }
    }
    out_of_reach(nearest);
  }

  /// The next point at `length` times the distance of the last two, on the plane across their direction.
  std::optional<Solution> step_beyond(const Solution& before, const Solution& at, double length) {
    Plane plane;
    for (std::size_t i = 0; i < unknown_count; ++i) {
      const double d = at.x[i] - before.x[i];
      plane.normal[i] = d / (size[i] * size[i]) / distance(before, at);
      plane.through[i] = at.x[i] + length * d;
    }
    try {
      const Solution s = solve_on(engine_, target_.operation, plane, plane.through);
      iterations_ += s.iterations;
      // far off the guess lies another branch
      return distance(s.x, plane.through) < std::abs(length) * distance(before, at) ? std::optional(s) : std::nullopt;
    } catch (const SolveError&) {
      return std::nullopt;
    }
  }

  /// The demand lies between two points of the line.
  Solution bisect(Solution a, Solution b) {
    while (true) {
      for (const Solution& from : {a, b}) {
        if (const auto s = attempt(target_.operation, target_.demand, from.x)) return *s;
      }
      const auto mid = split(a, b);
      if (!mid || distance(a, b) < 1e-9) return solve(target_.operation, target_.demand, a.x);
      (excess(a) * excess(*mid) <= 0.0 ? b : a) = *mid;
    }
  }

  /// A point of the line between two others, near the middle if it can be.
  std::optional<Solution> split(const Solution& a, const Solution& b) {
    for (const double share : {0.5, 0.2, 0.8, 0.05, 0.95, 0.01, 0.99}) {
      if (auto s = step_beyond(a, b, share - 1.0)) return s;
    }
    return std::nullopt;
  }

  static double distance(const Unknowns& a, const Unknowns& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < unknown_count; ++i) sum += std::pow((b[i] - a[i]) / size[i], 2);
    return std::sqrt(sum);
  }
  static double distance(const Solution& a, const Solution& b) { return distance(a.x, b.x); }
  static bool on_the_map(const Solution& s) { return s.x[n1] > lowest_of_design_n1 && s.x[n1] < highest_of_design_n1; }

  [[noreturn]] void out_of_reach(const Solution& nearest) const {
    throw SolveError("residual 'demand': " + std::string(demand_names[as_size(target_.demand.kind)]) + " = " +
                     std::to_string(target_.demand.value) + " is out of reach; the engine comes no nearer than " +
                     std::to_string(demanded_value(engine_, nearest.gas, target_.demand.kind)) + " at N1 " +
                     std::to_string(nearest.gas.speeds.n1_rpm) + " rpm");
  }

  const Turbofan& engine_;
  const Target& target_;
  int iterations_ = 0;
};

}  // namespace

SteadyPoint solve_steady(const Turbofan& engine, const Operation& operation, const Demand& demand,
                         const SteadyPoint* start) {
  require_valid(demand);
  Operation held = operation;
  held.fuel_flow_kg_s = engine.data().design.fuel_flow_kg_s;
  require_valid(held);
  const Target target{held, demand};
  const Unknowns x = start ? unknowns_of(engine, start->unknowns, start->gas.speeds, start->gas.fuel_flow_kg_s)
                           : cold_start(engine, held.flight);
  const Solution s = [&] {
    try {
      return solve_at(engine, target, x);
    } catch (const SolveError&) {
      return Approach(engine, target).run();
    }
  }();
  held.fuel_flow_kg_s = s.gas.fuel_flow_kg_s;
  return {held, s.gas, {unpack(s.x)}, s.iterations, s.residual};
}

}  // namespace ehm::engine_sim
