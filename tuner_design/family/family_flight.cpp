// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/family/family_flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/scenario/mission.h"
#include "engine_sim/simulation.h"
#include "tuner_design/flight/mission_scenario.h"
#include "tuner_design/monte_carlo/random_stream.h"
#include "tuner_design/wear/wear_law.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;

constexpr double case_s = 40.0, event_s = 20.0, judged_last_s = 2.0, judged_after_step_s = 10.0;
constexpr double wear_begins_s = 10.0, wear_a_minute = -0.01, step = -0.02, noise_factor = 3.0;
constexpr double slam_begins_s = 25.0, slam_depth = 0.92, slam_ends_s = 30.0;
constexpr double take_off_s = 420.0, landing_s = 6900.0, judged_every_s = 20.0;
constexpr std::size_t missing_sensor = 3;
constexpr int flights = 50, samples_a_flight = 30, steps_a_sample = 7, first_judged_flight = 10;
constexpr double cycles_a_flight = 12.0, told_wear_percent = 0.05;

sim::Scenario at_the_point(const FamilyFleet& fleet, RandomStream& random, std::size_t index) {
  sim::Scenario s;
  s.engine = std::make_shared<const sim::EngineDefinition>(fleet.engine);
  s.control = s.engine->control;
  s.sample_time_s = fleet.step_s;
  s.heat_soak = true;
  s.flight = {fleet.point.altitude_m, fleet.point.mach, fleet.point.delta_isa_k};
  s.demand = {sim::DemandKind::n1_rpm, fleet.fan_speed_rpm};
  const auto& health = s.engine->channels.health;
  for (std::size_t i = 0; i < health.size(); ++i)
    s.wear[health[i].parameter].initial = fleet.health_sigma(as_index(i)) * std::clamp(random.normal(), -3.0, 3.0);
  s.seed = static_cast<std::int64_t>(random.bits() >> 12);
  if (fleet.what == FamilyCase::rapid)
    s.health_changes.push_back({.time_s = event_s, .channel = index % health.size(), .change = step});
  if (fleet.what == FamilyCase::gradual)
    for (std::size_t i = 0; i < health.size(); ++i)
      s.health_changes.push_back({.time_s = wear_begins_s,
                                  .channel = i,
                                  .change = wear_a_minute * (case_s - wear_begins_s) / 60.0,
                                  .ramp_s = case_s - wear_begins_s});
  if (fleet.what == FamilyCase::slam) {
    const auto at = [&](double t, double share) {
      s.profile.push_back({t, s.flight, {sim::DemandKind::n1_rpm, share * fleet.fan_speed_rpm}, {}});
    };
    at(0.0, 1.0), at(slam_begins_s, 1.0), at(slam_begins_s + 0.1, slam_depth), at(slam_ends_s, slam_depth),
        at(slam_ends_s + 0.1, 1.0);
  }
  return s;
}

sim::Scenario scenario_of(const FamilyFleet& fleet, std::uint64_t seed, std::size_t index) {
  if (fleet.what == FamilyCase::flight)
    return mission_scenario(std::make_shared<const sim::EngineDefinition>(fleet.engine), fleet.step_s,
                            {.seed = seed, .mismatch = {}, .step = {}, .bias = {}}, index);
  RandomStream random(seed, index);
  return at_the_point(fleet, random, index);
}

/// 0 of nothing.
double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Flight {
 public:
  Flight(const FamilyFleet& fleet, std::uint64_t seed, std::size_t index)
      : fleet_(fleet), seed_(seed), index_(index), stepped_(index % fleet.engine.channels.health.size()) {
    const auto p = as_index(fleet.engine.channels.health.size());
    for (const auto& flier : fleet.fliers) {
      estimators_.push_back(flier ? flier->clone() : nullptr);
      outcomes_.emplace_back().errors = Eigen::ArrayXd::Zero(p);
      outcomes_.back().covered_of = Eigen::ArrayXd::Zero(p);
    }
    steps_s_.resize(outcomes_.size());
    for (std::size_t i = 0; i < fleet.engine.channels.sensors.size(); ++i) fused_.set(i);
    if (fleet.what == FamilyCase::missing) fused_.reset(missing_sensor);
  }

  std::vector<FamilyOutcome> run() {
    if (fleet_.what == FamilyCase::batches)
      fly_batches();
    else
      fly(fleet_.what == FamilyCase::flight ? sim::mission_seconds : case_s);
    for (std::size_t e = 0; e < outcomes_.size(); ++e) outcomes_[e].step_s = median(steps_s_[e]);
    return outcomes_;
  }

 private:
  void fly(double seconds) {
    sim::Simulation simulation(scenario_of(fleet_, seed_, index_));
    const auto samples = static_cast<std::int64_t>(seconds / fleet_.step_s);
    for (std::int64_t k = 0; k < samples; ++k) {
      const double t = static_cast<double>(k) * fleet_.step_s;
      const sim::EngineSample sample = simulation.next_sample();
      if (k == 0) before_ = conditions_of(sample);  // nothing acted before the first sample
      take(sample, 1, is_judged(t), t);
    }
  }

  /// Each flight is a new start of the engine, whose metal is in balance.
  void fly_batches() {
    const auto& channels = fleet_.engine.channels.health;
    std::vector<std::string> names;
    for (const auto& health : channels) names.emplace_back(sim::health_names[health.parameter]);
    const WearLaw law = wear_law(names, cycles_a_flight);
    const sim::Scenario first = scenario_of(fleet_, seed_, index_);
    for (int flight = 0; flight < flights; ++flight) {
      sim::Scenario worn = first;
      worn.seed = first.seed + flight;
      const Eigen::VectorXd wear_percent = law.at(flight);
      for (std::size_t i = 0; i < channels.size(); ++i)
        worn.wear[channels[i].parameter].initial += 0.01 * wear_percent(as_index(i));
      sim::Simulation simulation(worn);
      for (int k = 0; k < samples_a_flight; ++k) {
        for (int lost = 1; lost < steps_a_sample; ++lost) simulation.next_sample();
        const bool judge = k + 1 == samples_a_flight && flight >= first_judged_flight;
        const sim::EngineSample sample = simulation.next_sample();
        if (flight == 0 && k == 0) before_ = conditions_of(sample);
        take(sample, steps_a_sample, judge, 0.0);
      }
      for (const auto& estimator : estimators_)
        if (estimator) estimator->next_flight(told_wear_percent);
    }
  }

  static estimation::Conditions conditions_of(const sim::EngineSample& sample) {
    estimation::Conditions now;
    now.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
    now.actuators = Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
    return now;
  }

  void take(const sim::EngineSample& sample, int steps, bool judge, double t) {
    estimation::SensorVector y(as_index(sample.sensors.size()));
    for (std::size_t i = 0; i < sample.sensors.size(); ++i) y(as_index(i)) = sample.sensors[i].value;
    now_ = conditions_of(sample);
    for (std::size_t e = 0; e < estimators_.size(); ++e) {
      if (!estimators_[e]) continue;
      estimation::Estimator& estimator = *estimators_[e];
      const auto began = std::chrono::steady_clock::now();
      estimator.use(fused_);
      estimator.predict(before_, steps);
      estimator.innovate(y, now_);
      estimator.update(fused_, 1);
      steps_s_[e].push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count());
      note_answer(estimator, t, outcomes_[e]);
      if (judge) score(estimator, sample, outcomes_[e]);
    }
    before_ = now_;
  }

  bool is_judged(double t) {
    if (fleet_.what == FamilyCase::flight) {
      if (t < next_judged_s_ || t < take_off_s || t > landing_s) return false;
      next_judged_s_ = t + judged_every_s;
      return true;
    }
    return t >= (fleet_.what == FamilyCase::rapid ? event_s + judged_after_step_s : case_s - judged_last_s);
  }

  /// Half of the step, against what was estimated as it happened.
  void note_answer(const estimation::Estimator& estimator, double t, FamilyOutcome& out) {
    if (fleet_.what != FamilyCase::rapid || out.answer_s || t < event_s) return;
    const double h = estimator.estimate().health(as_index(stepped_));
    const auto e = static_cast<std::size_t>(&out - outcomes_.data());
    if (at_step_.size() <= e) at_step_.resize(outcomes_.size(), std::numeric_limits<double>::quiet_NaN());
    if (std::isnan(at_step_[e])) at_step_[e] = h;
    if (h <= at_step_[e] + 0.5 * step) out.answer_s = t - event_s;
  }

  void score(const estimation::Estimator& estimator, const sim::EngineSample& sample, FamilyOutcome& out) const {
    ++out.samples;
    const estimation::Estimate& e = estimator.estimate();
    if (!e.holds || estimator.distance(now_) > 1.0) return;
    ++out.held;
    for (std::size_t i = 0; i < sample.health.size(); ++i) {
      const auto at = as_index(i);
      const double error = 100.0 * (e.health(at) - sample.health[i]), sigma = 100.0 * e.health_sigma(at);
      out.squares += error * error;
      out.claims += sigma * sigma;
      out.errors(at) += error;
      ++out.judged;
      const double covered = std::abs(error) <= 1.96 * sigma ? 1.0 : 0.0;
      out.covered += covered;
      out.covered_of(at) += covered;
    }
  }

  const FamilyFleet& fleet_;
  std::uint64_t seed_;
  std::size_t index_;
  std::size_t stepped_;
  std::vector<std::unique_ptr<estimation::Estimator>> estimators_;
  std::vector<FamilyOutcome> outcomes_;
  std::vector<std::vector<double>> steps_s_;  ///< what each sample took, of the clock
  std::vector<double> at_step_;
  estimation::SensorMask fused_;
  estimation::Conditions before_, now_;
  double next_judged_s_ = 0.0;
};

}  // namespace

std::optional<std::vector<FamilyOutcome>> fly_family(const FamilyFleet& fleet, std::uint64_t seed, std::size_t index) {
  try {
    FamilyFleet noisy = fleet;
    if (fleet.what == FamilyCase::noise)
      for (sim::SensorChannel& sensor : noisy.engine.channels.sensors) sensor.noise_percent *= noise_factor;
    return Flight(noisy, seed, index).run();
  } catch (const sim::FlightError&) {
    return std::nullopt;
  }
}

}  // namespace ehm::tuner_design
