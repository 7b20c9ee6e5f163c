// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/faults/false_alarm_study.h"

#include <cmath>
#include <memory>

#include "deploy/runtime/long_work/parallel_for.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/monte_carlo/engine_motion.h"

namespace ehm::tuner_design {
namespace {

constexpr double flight_s = 600.0;
constexpr double wait_s = 2.0;  ///< beyond the convergence of the filter

/// Rows of the study.
enum Kind : std::size_t { bias, noise, other_sensor_fault, shift, ambiguous, slow_bias, implausible, kinds };

struct Tally {
  std::array<std::size_t, kinds> events{};
  std::uint64_t withheld = 0;
};

void note(const monitor::Event& event, Tally& tally) {
  namespace reason = idl::reject_reason;
  if (!event.raised) return;
  switch (event.kind) {
    case idl::EventKind::sensor_fault:
      ++tally.events[(event.detail & reason::bias) != 0    ? bias
                     : (event.detail & reason::noise) != 0 ? noise
                                                           : other_sensor_fault];
      return;
    case idl::EventKind::health_shift:
      ++tally.events[shift];
      return;
    case idl::EventKind::ambiguous_fault:
      ++tally.events[ambiguous];
      return;
    case idl::EventKind::slow_bias:
      ++tally.events[slow_bias];
      return;
    case idl::EventKind::implausible:
    case idl::EventKind::unlikely_engine:
      ++tally.events[implausible];
      return;
    default:
      return;
  }
}

/// Engines of the design's fleet, flown by its linear model.
class LinearFleet {
 public:
  LinearFleet(const design::Design& design, bool process_noise)
      : prepared_(std::make_shared<const design::Design>(design)),
        motion_(discretise(design.model), process_noise),
        H_(estimation::steady_gain(design.model).H),
        settle_samples_(samples(design.full.settling_s() + wait_s)),
        counted_samples_(samples(flight_s)) {}

  Tally fly(RandomStream random) const {
    const linear_model::LinearModel& model = prepared_.design->model;
    monitor::MonitorCycle cycle(prepared_, monitor::CycleOptions{});
    monitor::Sample sample = still_sample(model);
    const Eigen::VectorXd steady = H_ * health(model, random);
    estimation::StateVector dx = motion_.begin(random);
    estimation::SensorVector dy;
    Tally tally;
    for (int k = 0; k < settle_samples_ + counted_samples_; ++k) {
      if (k > 0) motion_.advance(dx, random);
      dy = steady;
      motion_.add_to_sensors(dy, dx);
      sample.sequence = static_cast<std::uint64_t>(k);
      sample.source_time_ns = std::llround(1e9 * model.sample_time_s * k);
      for (Eigen::Index i = 0; i < dy.size(); ++i)
        sample.sensor[as_size(i)] =
            model.sensors[as_size(i)].trim + dy(i) + model.sensor_noise_sigma(i) * random.normal();
      cycle.process(sample);
      if (k >= settle_samples_) {
        for (const monitor::Event& event : cycle.events()) note(event, tally);
        tally.withheld += !cycle.result().estimates;
      }
      cycle.clear_events();
    }
    return tally;
  }

 private:
  int samples(double seconds) const {
    return static_cast<int>(std::ceil(seconds / prepared_.design->model.sample_time_s));
  }
  static Eigen::VectorXd health(const linear_model::LinearModel& model, RandomStream& random) {
    Eigen::VectorXd h(model.health_sigma.size());
    for (Eigen::Index i = 0; i < h.size(); ++i) h(i) = model.health_sigma(i) * random.normal();
    return h;
  }
  static monitor::Sample still_sample(const linear_model::LinearModel& model) {
    monitor::Sample sample;
    sample.schema = idl::schema_version;
    sample.source_id = 1;
    if (model.operating_point) sample.flight = *model.operating_point;
    sample.sensor_count = static_cast<std::uint32_t>(model.sensors.size());
    sample.actuator_count = static_cast<std::uint32_t>(model.controls.size());
    sample.sensor_valid = ~0U;
    for (std::size_t i = 0; i < model.controls.size(); ++i) sample.actuator[i] = model.controls[i].trim;
    return sample;
  }

  monitor::PreparedDesign prepared_;
  EngineMotion motion_;
  Eigen::MatrixXd H_;
  int settle_samples_, counted_samples_;
};

/// P(N <= count) of a Poisson variable.
double poisson_cumulative(std::size_t count, double mean) {
  double term = std::exp(-mean), sum = term;
  for (std::size_t i = 1; i <= count; ++i) sum += term *= mean / static_cast<double>(i);
  return sum;
}

/// The mean at which P(N <= count) is `probability`; it falls with the mean.
double mean_with(std::size_t count, double probability) {
  double low = 0.0, high = 10.0 + 3.0 * static_cast<double>(count);
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (poisson_cumulative(count, middle) > probability ? low : high) = middle;
  }
  return low;
}

FalseAlarmRow row(const char* kind, double stated_per_hour, std::size_t events, double hours) {
  const auto [lower, upper] = poisson_interval(events);
  return {kind, stated_per_hour, events, static_cast<double>(events) / hours, lower / hours, upper / hours};
}

}  // namespace

std::array<double, 2> poisson_interval(std::size_t count) {
  constexpr double tail = 0.025;
  return {count == 0 ? 0.0 : mean_with(count - 1, 1.0 - tail), mean_with(count, tail)};
}

FalseAlarmStudy run_false_alarm_study(const design::Design& design, const FalseAlarmOptions& options,
                                      const std::function<void(double share)>& progress) {
  const LinearFleet fleet(design, options.process_noise);
  FalseAlarmStudy study;
  study.flights = static_cast<std::size_t>(std::ceil(3600.0 * options.hours / flight_s));
  study.flight_s = flight_s;
  study.hours = static_cast<double>(study.flights) * flight_s / 3600.0;
  study.process_noise = options.process_noise;
  std::vector<Tally> tallies(study.flights);
  long_work::parallel_for(
      study.flights, options.threads, [&](std::size_t i) { tallies[i] = fleet.fly(RandomStream(options.seed, i)); },
      [&](std::size_t done) { progress(static_cast<double>(done) / static_cast<double>(study.flights)); });
  Tally sum;
  for (const Tally& tally : tallies) {
    for (std::size_t i = 0; i < kinds; ++i) sum.events[i] += tally.events[i];
    sum.withheld += tally.withheld;
  }
  study.withheld = sum.withheld;
  const monitor::CycleOptions flown;
  const double abrupt = flown.faults.false_alarm_per_hour;
  // The innovation gate holds back single values only: it never declares a sensor by noise alone.
  study.rows = {
      row("sensor bias or ambiguous", abrupt, sum.events[bias] + sum.events[ambiguous], study.hours),
      row("sensor noise grew", abrupt, sum.events[noise], study.hours),
      row("sensor fault by other checks", 0.0, sum.events[other_sensor_fault], study.hours),
      // A step of health is named by the fault detector, a slower change by the shift detector.
      row("health shift", abrupt + flown.shift.false_alarm_per_hour, sum.events[shift], study.hours),
      // Of an engine of the fleet, whose health then looks like a bias: once a flight at most.
      row("slow bias",
          flown.faults.slow_bias_probability * static_cast<double>(design.model.sensors.size()) * 3600.0 / flight_s,
          sum.events[slow_bias], study.hours),
      // Likewise: an engine beyond warn_sigma in one of its health parameters, or in all its tuners together.
      row("estimate beyond the fleet",
          std::erfc(flown.fleet.warn_sigma / std::sqrt(2.0)) * static_cast<double>(1 + design.model.health.size()) *
              3600.0 / flight_s,
          sum.events[implausible], study.hours)};
  return study;
}

}  // namespace ehm::tuner_design
