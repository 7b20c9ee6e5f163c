// SPDX-License-Identifier: Apache-2.0
// Sensors and words as the field has them: coarse, slow, without noise, and with one bad word now and then.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "idl/wire_values.h"
#include "monitor/cycle/monitor_cycle.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tuner_design/design/design_tuner.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using idl::EventKind;

constexpr int settle = 2000, flown = 20'000;  // 5 min
constexpr std::array<std::size_t, 3> slow{3, 4, 5};

/// The made-up engine with `count` of its sensors, from the third on, in kelvin or in degrees Celsius.
linear_model::LinearModel with_temperatures(const char* unit, std::size_t count) {
  linear_model::LinearModel model = test::made_up_model(7, 10);
  const double zero = std::string_view(unit) == "degC" ? 273.15 : 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    model.sensors[i + 2].unit = unit;
    model.sensors[i + 2].trim -= zero;
  }
  return model;
}

TEST(FieldSensors, AFlightInCelsiusIsThatInKelvin) {
  const auto designed = [](const char* unit) {
    return std::make_shared<const design::Design>(tuner_design::design_tuner(with_temperatures(unit, 3), {}));
  };
  const auto kelvin = designed("K"), celsius = designed("degC");
  EXPECT_TRUE(celsius->ssee.health.isApprox(kelvin->ssee.health, 1e-9));
  EXPECT_TRUE(celsius->scaling.sensor.isApprox(kelvin->scaling.sensor, 1e-12));
  const Eigen::VectorXd h = kelvin->model.health_sigma;
  test::Flight a(kelvin->model, h, 5), b(celsius->model, h, 5);
  MonitorCycle in_kelvin(kelvin, CycleOptions{}), in_celsius(celsius, CycleOptions{});
  for (int k = 0; k < 3000; ++k) {
    Sample s = a.next(), t = b.next();
    if (k == 2000) s.sensor[3] += 200.0, t.sensor[3] += 200.0;  // out of rate in both
    in_kelvin.process(s);
    in_celsius.process(t);
    ASSERT_EQ(in_kelvin.result().reason, in_celsius.result().reason) << k;
    ASSERT_EQ(in_kelvin.events().size(), in_celsius.events().size()) << k;
    in_kelvin.clear_events();
    in_celsius.clear_events();
  }
  EXPECT_TRUE(in_celsius.watch().filter().health().isApprox(in_kelvin.watch().filter().health(), 1e-6));
}

struct Outcome {
  std::uint64_t estimates = 0, restarts = 0;
  double error2 = 0.0;     ///< mean square of the health errors over their published sigma, after settling
  double distance2 = 0.0;  ///< mean square of the health errors over the fleet's sigma
  std::vector<Event> events;

  int raised(EventKind kind) const {
    return static_cast<int>(
        std::count_if(events.begin(), events.end(), [&](const Event& e) { return e.kind == kind && e.raised; }));
  }
};

/// `spoil(sample, last)` may change each sample; `last` is the one before as it was handed over.
template <class Spoil>
Outcome fly(const std::shared_ptr<const design::Design>& design, int samples, Spoil spoil, double noise = 1.0) {
  test::Random random(7);
  linear_model::LinearModel truth = design->model;
  truth.sensor_noise_sigma *= noise;
  test::Flight flight(truth, truth.health_sigma.cwiseProduct(random.normal_vector(truth.health_sigma.size())), 11);
  MonitorCycle cycle(design, CycleOptions{});
  Outcome outcome;
  Sample last;
  double count = 0.0;
  for (int k = 0; k < samples; ++k) {
    Sample s = flight.next();
    spoil(s, last);
    last = s;
    cycle.process(s);
    for (const Event& e : cycle.events()) outcome.events.push_back(e);
    cycle.clear_events();
    outcome.estimates += cycle.result().estimates;
    if (k < settle || !cycle.result().estimates) continue;
    const Eigen::VectorXd error = cycle.watch().filter().health() - flight.health();
    const auto p = static_cast<double>(error.size());
    outcome.error2 += error.cwiseQuotient(cycle.watch().error().health_sigma()).squaredNorm() / p;
    outcome.distance2 += error.cwiseQuotient(truth.health_sigma).squaredNorm() / p;
    ++count;
  }
  outcome.error2 /= count;
  outcome.distance2 /= count;
  outcome.restarts = cycle.counters().restarts;
  return outcome;
}

const auto nothing = [](Sample&, const Sample&) {};

void hold(Sample& s, const Sample& last, std::size_t i, std::uint64_t samples) {
  if (s.sequence % samples != 0) s.sensor[i] = last.sensor[i];
}

void expect_quiet(const Outcome& outcome) {
  for (const EventKind kind : {EventKind::sensor_fault, EventKind::health_shift, EventKind::ambiguous_fault,
                               EventKind::slow_bias, EventKind::no_design, EventKind::operating_point})
    EXPECT_EQ(outcome.raised(kind), 0) << "kind " << static_cast<int>(kind);
}

TEST(FieldSensors, CoarseTemperaturesAreUsed) {
  const auto design = test::made_up_design();
  for (const double noise : {1.0, 0.0}) {
    const Outcome outcome = fly(
        design, flown,
        [&](Sample& s, const Sample&) {
          for (const std::size_t i : slow) {
            const double step = 0.5 * design->model.sensor_noise_sigma(as_index(i));
            s.sensor[i] = step * std::round(s.sensor[i] / step);
          }
        },
        noise);
    expect_quiet(outcome);
    EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(flown));
    EXPECT_LT(outcome.error2, 4.0);
  }
}

TEST(FieldSensors, SlowTemperaturesAreFusedOnceAndNamed) {
  const auto outcome = fly(test::made_up_design(), flown, [](Sample& s, const Sample& last) {
    for (const std::size_t i : slow) hold(s, last, i, 33);
  });
  expect_quiet(outcome);
  EXPECT_EQ(outcome.raised(EventKind::slow_sensor), 3);
  EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(flown));
  EXPECT_LT(outcome.error2, 4.0);
}

TEST(FieldSensors, ADesignThatKnowsOfSlowAndCoarseSensorsFusesEachValueHonestly) {
  linear_model::LinearModel model = test::made_up_model(7, 10);
  model.sensor_resolution = Eigen::VectorXd::Zero(7);
  model.sensor_update_period_s = Eigen::VectorXd::Zero(7);
  for (const std::size_t i : slow) {
    const auto at = as_index(i);
    model.sensor_resolution(at) = model.sensor_noise_sigma(at);
    model.sensor_update_period_s(at) = 33.0 * model.sample_time_s;
    model.sensor_noise_sigma(at) *= std::sqrt(33.0 * (1.0 + 1.0 / 12.0));
  }
  const auto design =
      std::make_shared<const design::Design>(tuner_design::design_tuner(model, design::DesignOptions{}));
  const linear_model::LinearModel own = test::made_up_model(7, 10);
  test::Random random(5);
  const Outcome outcome = fly(
      design, flown,
      [&](Sample& s, const Sample& last) {
        for (const std::size_t i : slow) {
          // The flight's noise is the counted one; the sensor's own takes its place.
          const double q = model.sensor_resolution(as_index(i));
          const double noise = own.sensor_noise_sigma(as_index(i)) * random.normal();
          s.sensor[i] = q * std::round((s.sensor[i] + noise) / q);
          hold(s, last, i, 33);
        }
      },
      1e-3);
  expect_quiet(outcome);
  EXPECT_EQ(outcome.raised(EventKind::slow_sensor), 0);
  EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(flown));
}

TEST(FieldSensors, OnePercentOfBadWordsChangesNothing) {
  const auto design = test::made_up_design();
  const Outcome clean = fly(design, flown, nothing);
  for (const double word : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    test::Random random(3);
    const Outcome outcome = fly(design, flown, [&](Sample& s, const Sample&) {
      if (random.uniform(0.0, 1.0) > 0.01) return;
      switch (static_cast<int>(random.uniform(0.0, 3.0))) {
        case 0:
          s.flight.altitude_m = word;
          return;
        case 1:
          s.flight.mach = word;
          return;
        default:
          s.actuator[0] = word;
      }
    });
    expect_quiet(outcome);
    EXPECT_EQ(outcome.raised(EventKind::condition_fault), 0);
    EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(flown));
    EXPECT_EQ(outcome.restarts, 0u);
    EXPECT_NEAR(outcome.distance2, clean.distance2, 0.02 * clean.distance2);
  }
}

TEST(FieldSensors, AnAircraftThatLeavesThePointStillEndsTheEstimates) {
  auto moved = std::make_shared<design::Design>(*test::made_up_design());
  moved->model.operating_point = linear_model::OperatingPoint{10668.0, 0.8, 0.0};
  const Outcome outcome = fly(moved, settle + 200, [&](Sample& s, const Sample&) {
    if (s.sequence >= settle) s.flight.altitude_m = 3000.0;
  });
  EXPECT_EQ(outcome.raised(EventKind::operating_point), 1);
  EXPECT_EQ(outcome.raised(EventKind::condition_fault), 1);
  EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(settle + 5)) << "bridged for 5 samples, 75 ms";
}

TEST(FieldSensors, AModelWithoutControlsAndOutputsFlies) {
  linear_model::LinearModel model = test::made_up_model(7, 10);
  model.controls.clear();
  model.auxiliary.clear();
  for (Eigen::MatrixXd* matrix : {&model.B, &model.D, &model.G}) matrix->resize(matrix->rows(), 0);
  for (Eigen::MatrixXd* matrix : {&model.F, &model.G, &model.N}) matrix->resize(0, matrix->cols());
  const auto design =
      std::make_shared<const design::Design>(tuner_design::design_tuner(model, design::DesignOptions{}));
  const Outcome outcome = fly(design, settle + 1000, nothing);
  EXPECT_TRUE(outcome.events.empty());
  EXPECT_EQ(outcome.estimates, static_cast<std::uint64_t>(settle + 1000));
  EXPECT_LT(outcome.error2, 4.0);
}

}  // namespace
