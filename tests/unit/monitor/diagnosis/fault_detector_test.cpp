// SPDX-License-Identifier: Apache-2.0
// Names of abrupt faults, on the linear truth of the made-up engine.

#include "monitor/diagnosis/fault_detector.h"

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

constexpr int settle = 2000;

struct Said {
  std::vector<Event> events;
  std::vector<int> samples;  ///< after the onset
  const Event* first(idl::EventKind kind) const {
    for (const Event& e : events)
      if (e.kind == kind && e.raised) return &e;
    return nullptr;
  }
};

/// What the cycle says while `spoil` changes the samples from the onset on, for 400 samples.
template <class Spoil>
Said said(std::uint64_t seed, Spoil spoil) {
  const auto design = test::made_up_design();
  test::Random random(seed);
  test::Flight flight(design->model, design->model.health_sigma.cwiseProduct(random.normal_vector(10)), seed);
  MonitorCycle cycle(design, CycleOptions{});
  Said result;
  for (int k = 0; k < settle + 400; ++k) {
    if (k == settle) {
      EXPECT_EQ(cycle.events().raised_total(), 0u);
    }
    Sample s = k >= settle ? spoil(flight, k - settle) : flight.next();
    cycle.process(s);
    for (const Event& e : cycle.events()) result.events.push_back(e), result.samples.push_back(k - settle);
    cycle.clear_events();
  }
  return result;
}

TEST(FaultDetector, NamesABiasWithItsSizeAndOnset) {
  const auto& model = test::made_up_design()->model;
  for (int sensor = 0; sensor < 7; ++sensor) {
    const double size = (sensor % 2 ? -8.0 : 8.0) * model.sensor_noise_sigma(sensor);
    const Said result = said(static_cast<std::uint64_t>(100 + sensor), [&](test::Flight& flight, int) {
      Sample s = flight.next();
      s.sensor[as_size(sensor)] += size;
      return s;
    });
    const Event* fault = result.first(idl::EventKind::sensor_fault);
    ASSERT_NE(fault, nullptr) << sensor;
    EXPECT_EQ(fault->channel, static_cast<std::uint32_t>(sensor));
    EXPECT_EQ(fault->detail & idl::reject_reason::bias, idl::reject_reason::bias);
    EXPECT_NEAR(fault->value / size, 1.0, 0.4) << sensor;  // 5 samples see it to sigma/sqrt(5)
    EXPECT_LE(result.samples.front(), 200) << sensor;      // 3 s
    // Onset: the last sample before the event's age.
    const double onset_s = result.samples.front() * model.sample_time_s - fault->age_s;
    EXPECT_NEAR(onset_s, -model.sample_time_s, 0.1) << sensor;
    EXPECT_EQ(result.first(idl::EventKind::health_shift), nullptr) << sensor;
  }
}

TEST(FaultDetector, NamesGrownNoise) {
  const auto& model = test::made_up_design()->model;
  test::Random random(3);
  const Said result = said(7, [&](test::Flight& flight, int) {
    Sample s = flight.next();
    s.sensor[4] += std::sqrt(15.0) * model.sensor_noise_sigma(4) * random.normal();  // four times in all
    return s;
  });
  const Event* fault = result.first(idl::EventKind::sensor_fault);
  ASSERT_NE(fault, nullptr);
  EXPECT_EQ(fault->channel, 4u);
  EXPECT_EQ(fault->detail & idl::reject_reason::noise, idl::reject_reason::noise);
  EXPECT_GT(fault->value, fault->threshold);
}

TEST(FaultDetector, AStepOfHealthIsNoSensorFault) {
  for (int parameter = 0; parameter < 10; ++parameter) {
    const Said result = said(static_cast<std::uint64_t>(200 + parameter), [&](test::Flight& flight, int k) {
      if (k == 0) {
        Eigen::VectorXd h = flight.health();
        h(parameter) -= 0.04;
        flight.set_health(h);
      }
      return flight.next();
    });
    EXPECT_EQ(result.first(idl::EventKind::sensor_fault), nullptr) << parameter;
    ASSERT_NE(result.first(idl::EventKind::health_shift), nullptr) << parameter;
  }
}

TEST(FaultDetector, OneWildValueAndATrainOfLostSamplesSayNothing) {
  const auto& model = test::made_up_design()->model;
  const Said wild = said(11, [&](test::Flight& flight, int k) {
    Sample s = flight.next();
    if (k == 50) s.sensor[3] += 30.0 * model.sensor_noise_sigma(3);
    return s;
  });
  EXPECT_TRUE(wild.events.empty());
  const Said lossy = said(12, [](test::Flight& flight, int k) {
    for (int lost = 0; lost < (k % 5 == 0 ? 3 : 0); ++lost) flight.next();
    return flight.next();
  });
  EXPECT_TRUE(lossy.events.empty());
}

TEST(FaultDetector, FindsABiasThroughTwentyPercentOfLoss) {
  const auto& model = test::made_up_design()->model;
  const Said result = said(13, [&](test::Flight& flight, int k) {
    if (k % 4 == 0) flight.next();
    Sample s = flight.next();
    s.sensor[5] += 6.0 * model.sensor_noise_sigma(5);
    return s;
  });
  const Event* fault = result.first(idl::EventKind::sensor_fault);
  ASSERT_NE(fault, nullptr);
  EXPECT_EQ(fault->channel, 5u);
}

TEST(FaultSignatures, AnswerTheFilterAsFlown) {
  // A bias in a noise-free flight leaves exactly the tabulated trace, in innovations and state.
  const auto design = test::made_up_design();
  linear_model::LinearModel quiet = design->model;
  quiet.sensor_noise_sigma.setZero();
  const auto tables = fault_tables(*design);
  test::Flight flight(quiet, Eigen::VectorXd::Zero(10), 1);
  CycleOptions open;
  open.checks.gate_sigma = 20.0;
  open.checks.stuck_samples = 100'000;  // without noise every sensor looks stuck
  MonitorCycle cycle(design, open);
  OnsetRing ring(tables->full);
  for (int age = 0; age < 60; ++age) {
    Sample s = flight.next();
    s.sensor[2] += 3.0 * design->model.sensor_noise_sigma(2);
    cycle.process(s);
    const Eigen::VectorXd expected = 3.0 * tables->full.state.col(age * 7 + 2);
    EXPECT_TRUE(cycle.watch().filter().estimate().isApprox(expected, 1e-6)) << age;
    ring.step(cycle.result().innovation.cwiseQuotient(design->scaling.sensor), estimation::SensorMask(0x7f), 1);
    EXPECT_NEAR(ring.best(2).size, 3.0, 1e-6);
    EXPECT_NEAR(ring.best(2).ratio, 9.0 * tables->full.information(2, age), 1e-6 * ring.best(2).ratio);
    EXPECT_EQ(ring.best(2).age, age);
  }
}

TEST(FaultSignatures, NoiseStaysBelowTheChiSquareOfWhiteNoise) {
  // Largest l over all hypotheses and onsets of an hour: the threshold for one alarm an hour must not be passed more
  // than a few times, or the colour of the innovations is not harmless.
  const auto design = test::made_up_design();
  FaultOptions options;
  options.false_alarm_per_hour = 1.0;
  const auto tables = fault_tables(*design);
  const FaultDetector detector(options, tables, design->model.sample_time_s);
  test::Flight flight(design->model, Eigen::VectorXd::Zero(10), 5);
  MonitorCycle cycle(design, CycleOptions{});
  OnsetRing ring(tables->full);
  int above = 0;
  bool was_above = false;
  for (int k = 0; k < 60'000; ++k) {
    cycle.process(flight.next());
    if (k < settle) continue;
    ring.step(cycle.result().innovation.cwiseQuotient(design->scaling.sensor), estimation::SensorMask(0x7f), 1);
    const bool now = ring.largest() > detector.threshold();
    above += now && !was_above;
    was_above = now;
  }
  EXPECT_LE(above, 2);
  EXPECT_GT(detector.threshold(), 20.0);
}

}  // namespace
