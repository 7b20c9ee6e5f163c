// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/margin_study.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "deploy/runtime/long_work/parallel_for.h"
#include "engine_sim/scenario/life.h"
#include "engine_sim/scenario/mission.h"
#include "monitor/onboard/on_board_estimator.h"
#include "monitor/onboard/take_off_margin.h"
#include "tuner_design/flight/estimated_flight.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;

constexpr double step_s = 0.1, within = 1.96;
constexpr double wear_spread = 0.3;
/// What the estimator is told of the wear between two flights of the study, percent of each parameter: the table's
/// largest, of the HPC's flow capacity, is a quarter.
constexpr double expected_wear_percent = 0.25;

struct Judged {
  double truth_k, error_k, sigma_k;
};

/// One of the fleet: how fast it wears, and how it was built.
class WearingEngine {
 public:
  WearingEngine(const MarginStudyOptions& options, std::size_t index)
      : random_(options.seed, index), engine_(flown_engine(*options.engine, step_s)) {
    for (double& f : pace_) f = std::max(0.0, 1.0 + wear_spread * random_.normal());
    build_ = sim::drawn_mismatch({true, true, false}, random_.bits());
    days_.seed = random_.bits();
  }

  sim::HealthVector health_at(int cycles) const {
    sim::Life life{static_cast<double>(cycles)};
    life.pace = pace_;
    return sim::health_of(life);
  }
  sim::Scenario flight_at(int cycles) {
    sim::Scenario s = mission_scenario(engine_, step_s, days_, static_cast<std::size_t>(cycles));
    s.mismatch = build_;
    const sim::Mismatch inputs = sim::drawn_mismatch({false, false, true}, random_.bits());
    for (std::size_t i = 0; i < inputs.size(); ++i) s.mismatch[i] += inputs[i];
    const sim::HealthVector health = health_at(cycles);
    for (std::size_t j = 0; j < health.size(); ++j) s.wear[j] = {.initial = health[j]};
    for (sim::ProfilePoint& point : s.profile) point.time_s *= shortened;
    return s;
  }
  sim::Turbofan as_built() const { return sim::Turbofan(sim::built(engine_->data, build_)); }

 private:
  RandomStream random_;
  std::shared_ptr<const sim::EngineDefinition> engine_;
  sim::HealthVector pace_{};
  sim::Mismatch build_{};
  MissionDraw days_;
};

/// One engine from its first flight to its last.
std::vector<Judged> live(const MarginStudyOptions& options, const std::shared_ptr<const onboard::OnBoardModel>& model,
                         std::size_t index) {
  WearingEngine engine(options, index);
  const sim::Turbofan truth = engine.as_built();
  const double thrust_n = onboard::take_off_thrust_n(model->engine());
  onboard::OnBoardEstimator estimator(model);
  onboard::Learned known = onboard::learned_nothing(*model);
  estimation::SensorMask all;
  for (std::size_t i = 0; i < model->sensors().size(); ++i) all.set(i);
  std::vector<Judged> life;
  for (int cycles = 0; cycles <= life_cycles; cycles += cycles_between) {
    sim::Simulation simulation(engine.flight_at(cycles));
    estimator.begin_with(known, cycles == 0 ? 0.0 : expected_wear_percent);
    estimate_flight(
        simulation, shortened * sim::mission_seconds, step_s, estimator, [&](const auto&, double) { return all; },
        [](const auto&, double) {});
    known = estimator.learned();
    const onboard::TakeOffMargin told = onboard::take_off_margin(*model, known);
    const double truth_k = onboard::egt_margin_k(truth, engine.health_at(cycles), thrust_n);
    life.push_back({truth_k, told.margin_k - truth_k, told.sigma_k});
  }
  return life;
}

/// Of all engines after one of their flights; `flight` counts from 0.
MarginAtCycles pooled(const std::vector<std::optional<std::vector<Judged>>>& lives, int flight) {
  MarginAtCycles at{.cycles = flight * cycles_between};
  double flown = 0.0;
  for (const auto& life : lives) {
    if (!life) continue;
    const Judged& j = (*life)[static_cast<std::size_t>(flight)];
    ++flown;
    at.truth_k += j.truth_k;
    at.error_rms_k += j.error_k * j.error_k;
    at.sigma_k += j.sigma_k;
    at.coverage += std::abs(j.error_k) <= within * j.sigma_k;
  }
  if (flown == 0.0) return at;
  for (double* mean : {&at.truth_k, &at.error_rms_k, &at.sigma_k, &at.coverage}) *mean /= flown;
  at.error_rms_k = std::sqrt(at.error_rms_k);
  return at;
}

}  // namespace

MarginStudy run_margin_study(const MarginStudyOptions& options, const std::function<void(double)>& progress) {
  onboard::OnBoardOptions onboard;
  onboard.sample_time_s = step_s;
  const auto model = std::make_shared<const onboard::OnBoardModel>(flown_engine(*options.engine, step_s), onboard);
  std::vector<std::optional<std::vector<Judged>>> lives(options.engines);
  std::vector<std::string> why(options.engines);
  long_work::parallel_for(
      options.engines, options.threads,
      [&](std::size_t i) {
        try {
          lives[i] = live(options, model, i);
        } catch (const std::exception& e) {
          why[i] = e.what();
        }
      },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(options.engines)); });

  MarginStudy study{.options = options, .failed = {}, .by_cycles = {}};
  for (std::size_t i = 0; i < lives.size(); ++i)
    if (!lives[i]) study.failed.push_back({i, why[i]});
  for (int flight = 0; flight < flights_of_a_life && study.failed.size() < options.engines; ++flight) {
    const MarginAtCycles& at = study.by_cycles.emplace_back(pooled(lives, flight));
    study.error_rms_k += at.error_rms_k * at.error_rms_k / flights_of_a_life;
    study.coverage += at.coverage / flights_of_a_life;
  }
  study.error_rms_k = std::sqrt(study.error_rms_k);
  return study;
}

}  // namespace ehm::tuner_design
