// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/flight_engine.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/sensor_lags.h"
#include "engine_sim/scenario/mission.h"
#include "engine_sim/simulation.h"
#include "monitor/onboard/on_board_estimator.h"
#include "tuner_design/monte_carlo/random_stream.h"

namespace ehm::tuner_design {
namespace {

namespace sim = engine_sim;

constexpr double nominal_step_s = 0.015, within = 1.96;
constexpr double take_off_s = 420.0, early_s = 700.0, landing_s = 6900.0;
constexpr double judged_every_s = 20.0, after_slam_s = 30.0;
/// Cruise, long enough after the level was reached for spools and metal to rest.
constexpr double steady_s[][2] = {{1760.0, 3600.0}, {3960.0, 5400.0}};
/// Where power is set within seconds: take-off, top of climb, step climb and its end, descent, approach.
constexpr double slams_s[] = {410.0, 1560.0, 3600.0, 3780.0, 5400.0, 6590.0, 6780.0};

sim::Scenario scenario_of(const FlightStudyOptions& options, std::size_t index) {
  RandomStream random(options.seed, index);
  sim::Scenario s;
  s.engine = flown_engine(*options.engine, options.step_s);
  s.control = s.engine->control;
  s.sample_time_s = options.step_s;
  s.seed = static_cast<std::int64_t>(random.bits() >> 12);
  s.heat_soak = options.heat_soak;
  for (const sim::HealthChannel& health : s.engine->channels.health)
    s.wear[health.parameter].initial = health.sigma * std::clamp(random.normal(), -3.0, 3.0);
  s.mismatch = sim::drawn_mismatch(options.mismatch, random.bits());
  const sim::MissionOptions mission{.delta_isa_k = std::clamp(8.0 * random.normal(), -20.0, 20.0),
                                    .offtake = 0.5 + random.uniform(),
                                    .power = 1.0 + 0.02 * (random.uniform() - 0.5)};
  s.profile = sim::two_hour_mission(s.engine->data, mission);
  s.flight = s.profile.front().flight;
  s.demand = s.profile.front().demand;
  return s;
}

bool is_steady(double t) {
  return std::any_of(std::begin(steady_s), std::end(steady_s),
                     [t](const auto& range) { return t >= range[0] && t < range[1]; });
}

bool after_slam(double t) {
  return std::any_of(std::begin(slams_s), std::end(slams_s), [t](double s) { return t >= s && t < s + after_slam_s; });
}

template <class Vector>
void judge(const Vector& estimate, const Vector& sigma, const std::vector<double>& truth,
           std::vector<ChannelScore>& scores) {
  for (std::size_t i = 0; i < scores.size(); ++i) {
    ++scores[i].judged;
    if (std::abs(estimate(as_index(i)) - truth[i]) <= within * sigma(as_index(i))) ++scores[i].covered;
  }
}

class Flight {
 public:
  Flight(const FlightStudyOptions& options, std::shared_ptr<const onboard::OnBoardModel> model, std::size_t index)
      : options_(options), simulation_(scenario_of(options, index)), estimator_(std::move(model)) {
    const auto& channels = options.engine->channels;
    out_.health.resize(channels.health.size());
    out_.steady.resize(channels.auxiliary.size());
    out_.slam.resize(channels.auxiliary.size());
    for (std::size_t i = 0; i < channels.sensors.size(); ++i) fused_.set(i);
    for (const std::size_t sensor : options.missing) fused_.reset(sensor);
    estimator_.use(fused_);
  }

  FlightOutcome run() {
    const auto samples = static_cast<std::int64_t>(sim::mission_seconds / options_.step_s);
    for (std::int64_t k = 0; k < samples; ++k)
      take(simulation_.next_sample(), static_cast<double>(k) * options_.step_s);
    return out_;
  }

 private:
  void take(const sim::EngineSample& sample, double t) {
    estimation::SensorVector y(as_index(sample.sensors.size()));
    for (std::size_t i = 0; i < sample.sensors.size(); ++i) y(as_index(i)) = sample.sensors[i].value;
    estimation::Conditions now;
    now.flight = {sample.flight.altitude_m, sample.flight.mach, sample.flight.delta_isa_k};
    now.actuators = Eigen::Map<const Eigen::VectorXd>(sample.actuators.data(), as_index(sample.actuators.size()));
    estimator_.predict(before_, 1);
    estimator_.innovate(y, now);
    estimator_.update(fused_, 1);
    before_ = now;
    ++out_.samples;
    if (!estimator_.estimate().holds) return;
    ++out_.estimated;
    score(sample, t);
  }

  void score(const sim::EngineSample& sample, double t) {
    const estimation::Estimate& e = estimator_.estimate();
    const auto reached = [&](double time_s) { return t >= time_s && t - options_.step_s < time_s; };
    if (reached(early_s)) squares(sample, out_.ssee_700, out_.claim_700);
    if (reached(landing_s)) squares(sample, out_.ssee_landing, out_.claim_landing);
    if (t < next_judged_s_ && !after_slam(t)) return;
    if (t >= next_judged_s_) {
      next_judged_s_ += judged_every_s;
      if (t >= take_off_s && t <= landing_s) judge(e.health, e.health_sigma, sample.health, out_.health);
      if (is_steady(t)) {
        judge(e.auxiliary, e.auxiliary_sigma, sample.auxiliary, out_.steady);
      }
    }
    if (after_slam(t)) judge(e.auxiliary, e.auxiliary_sigma, sample.auxiliary, out_.slam);
  }

  void squares(const sim::EngineSample& sample, double& ssee, double& claim) const {
    const estimation::Estimate& e = estimator_.estimate();
    ssee = claim = 0.0;
    for (std::size_t i = 0; i < sample.health.size(); ++i) {
      const double error = 100.0 * (e.health(as_index(i)) - sample.health[i]);
      const double sigma = 100.0 * e.health_sigma(as_index(i));
      ssee += error * error;
      claim += sigma * sigma;
    }
  }

  const FlightStudyOptions& options_;
  sim::Simulation simulation_;
  onboard::OnBoardEstimator estimator_;
  estimation::SensorMask fused_;
  estimation::Conditions before_;
  FlightOutcome out_;
  double next_judged_s_ = 0.0;
};

}  // namespace

std::shared_ptr<const sim::EngineDefinition> flown_engine(const sim::EngineDefinition& engine, double step_s) {
  auto copy = std::make_shared<sim::EngineDefinition>(engine);
  for (sim::SensorChannel& sensor : copy->channels.sensors) {
    sensor.noise_percent *= std::sqrt(nominal_step_s / step_s);
    sensor.noise_of = sim::NoiseOf::reading;
  }
  sim::add_lags({}, copy->channels.sensors);
  return copy;
}

FlightOutcome fly(const FlightStudyOptions& options, std::shared_ptr<const onboard::OnBoardModel> model,
                  std::size_t index) {
  return Flight(options, std::move(model), index).run();
}

}  // namespace ehm::tuner_design
