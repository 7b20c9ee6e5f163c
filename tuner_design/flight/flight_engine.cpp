// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/flight/flight_engine.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/engines/sensor_lags.h"
#include "engine_sim/scenario/mission.h"
#include "monitor/onboard/on_board_estimator.h"
#include "tuner_design/flight/estimated_flight.h"

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

/// A step that is found later than this was found by another cause.
constexpr double latest_find_s = 60.0;

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
      : options_(options),
        simulation_(
            mission_scenario(flown_engine(*options.engine, options.step_s), options.step_s, options.draw, index)),
        estimator_(options.estimator ? options.estimator->clone()
                                     : std::make_unique<onboard::OnBoardEstimator>(std::move(model))),
        onboard_(options.estimator ? nullptr : static_cast<const onboard::OnBoardEstimator*>(estimator_.get())),
        stepped_(static_cast<int>(stepped_channel(*options.engine, index))),
        biased_(as_index(biased_sensor(*options.engine, index))),
        bias_sign_(index / options.engine->channels.sensors.size() % 2 == 0 ? 1.0 : -1.0) {
    const auto& channels = options.engine->channels;
    out_.health.resize(channels.health.size());
    out_.steady.resize(channels.auxiliary.size());
    out_.slam.resize(channels.auxiliary.size());
    for (std::size_t i = 0; i < channels.sensors.size(); ++i) fused_.set(i);
    for (const std::size_t sensor : options.missing) fused_.reset(sensor);
  }

  FlightOutcome run() {
    estimate_flight(
        simulation_, sim::mission_seconds, options_.step_s, *estimator_,
        [&](estimation::SensorVector& y, double t) { return spoiled(y, t); },
        [&](const sim::EngineSample& sample, double t) { take(sample, t); });
    return out_;
  }

 private:
  void take(const sim::EngineSample& sample, double t) {
    ++out_.samples;
    note_step(t);
    note_bias(t);
    if (!estimator_->estimate().holds) return;
    ++out_.estimated;
    score(sample, t);
  }

  /// The biased sensor from its time on; which are good: all but those that are missing, or were found biased.
  estimation::SensorMask spoiled(estimation::SensorVector& y, double t) const {
    if (const auto& bias = options_.draw.bias; bias && t >= bias->at_s) {
      const double sigma = 0.01 * options_.engine->channels.sensors[as_size(biased_)].noise_percent;
      y(biased_) *= 1.0 + bias_sign_ * bias->sigmas * sigma;
    }
    return fused_;
  }

  void note_bias(double t) {
    const int biased = estimator_->estimate().biased;
    if (biased < 0 || !fused_[as_size(biased)]) return;
    fused_.reset(as_size(biased));  // as the monitor leaves it out
    const double after_s = options_.draw.bias ? t - options_.draw.bias->at_s : -1.0;
    if (after_s < 0.0 || biased != biased_) ++out_.bias.false_alarms;
    if (after_s >= 0.0 && after_s <= latest_find_s && !out_.bias.found_after_s) {
      out_.bias.found_after_s = after_s;
      out_.bias.named = biased == biased_;
    }
  }

  void note_step(double t) {
    if (onboard_ == nullptr || onboard_->steps_found() == found_) return;
    found_ = onboard_->steps_found();
    if (estimator_->estimate().biased >= 0) return;  // it was a sensor: note_bias()
    const double after_s = options_.draw.step ? t - options_.draw.step->at_s : -1.0;
    if (after_s < 0.0 || after_s > latest_find_s) {
      ++out_.step.false_alarms;
    } else if (!out_.step.found_after_s) {
      out_.step.found_after_s = after_s;
      out_.step.named = estimator_->estimate().stepped == stepped_;
    }
  }

  void score(const sim::EngineSample& sample, double t) {
    const estimation::Estimate& e = estimator_->estimate();
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
    const estimation::Estimate& e = estimator_->estimate();
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
  std::unique_ptr<estimation::Estimator> estimator_;
  const onboard::OnBoardEstimator* onboard_;  ///< the same, where it is that one
  int stepped_;
  Eigen::Index biased_;
  double bias_sign_;
  std::int64_t found_ = 0;
  estimation::SensorMask fused_;
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
