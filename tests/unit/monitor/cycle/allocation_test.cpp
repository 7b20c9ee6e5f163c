// SPDX-License-Identifier: Apache-2.0
// The data path allocates nothing after start, and an engine is no larger than stated: every operator new of the
// process is counted.

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <memory>

#include "monitor/shared/engine_slot.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"

namespace {

using namespace ehm;

TEST(Allocation, TheCounterCounts) {
  const long before = test::allocation_count();
  ::operator delete(::operator new(1));  // a new expression could be optimised away
  EXPECT_EQ(test::allocation_count(), before + 1);
}

TEST(Allocation, NoneOnTheCyclePath) {
  const auto design = test::made_up_design();
  test::Flight flight(design->model, Eigen::VectorXd::Constant(10, -0.01), 1);
  monitor::MonitorCycle cycle(design, monitor::CycleOptions{});
  // The flight visits every branch: converging, bridging, excluded sensor, no design, off design, shift, gap, restart,
  // a sequence that stands, stamps that are not set.
  std::vector<monitor::Sample> samples;
  for (int k = 0; k < 6000; ++k) {
    if (k == 1500) flight.set_health(Eigen::VectorXd::Constant(10, -0.05));
    monitor::Sample s = flight.next();
    if (k >= 2500 && k < 2600) s.sensor[1] = std::numeric_limits<double>::quiet_NaN();
    if (k >= 3500 && k < 3600) s.sensor_valid &= ~0b11u;
    if (k >= 2900 && k < 3000) s.sensor[2] += 8.0 * design->model.sensor_noise_sigma(2);
    if (k >= 4500 && k < 4510) s.actuator[0] *= 1.5;
    if (k >= 4700 && k < 4720) s.sequence = 4699;
    if (k >= 4800 && k < 4900) s.source_time_ns = 0;
    if (k >= 5000 && k < 5010) continue;
    if (k >= 5500) s.source_time_ns -= 60'000'000'000;
    samples.push_back(s);
  }
  const long before = test::allocation_count();
  for (const auto& s : samples) {
    cycle.process(s);
    cycle.no_input(0.001);
    cycle.clear_events();
  }
  cycle.reset();
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_GT(cycle.counters().withheld, 0u);
  EXPECT_GT(cycle.counters().restarts, 1u);
  EXPECT_GT(cycle.events().raised_total(), 4u);
}

TEST(Allocation, NoneAtALanding) {
  const auto design = test::made_up_design();
  test::Flight flight(design->model, Eigen::VectorXd::Zero(10), 2);
  monitor::EngineSlot slot(monitor::PreparedDesign(design), monitor::CycleOptions{});
  std::vector<monitor::Sample> samples;
  for (int k = 0; k < 1000; ++k) {
    samples.push_back(flight.next());
    samples.back().flight = {9000.0, k < 500 ? 0.8 : 0.0, 0.0};
  }
  int landed = 0;
  const long before = test::allocation_count();
  for (const monitor::Sample& sample : samples) {
    if (slot.cycle.process(sample) && slot.flights.follow(slot.cycle, slot.fan)) ++landed;
    slot.cycle.clear_events();
  }
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_EQ(landed, 1);
}

// An engine that leaves gives its filter back on the cycle's thread (EngineSlot::vacate).
TEST(Allocation, NoneWhenACycleBecomesAsItWas) {
  monitor::CycleOptions options;
  options.limits.push_back({test::made_up_design()->model.health.front().name, -0.1, 0.1, 0.0});
  const monitor::MonitorCycle pristine(test::made_up_design(), options);
  monitor::MonitorCycle used(pristine);
  test::Flight flight(test::made_up_design()->model, Eigen::VectorXd::Zero(10), 3);
  monitor::Sample sample;
  for (int i = 0; i < 500; ++i) used.process(sample = flight.next());
  const long before = test::allocation_count();
  used = pristine;
  EXPECT_EQ(test::allocation_count(), before);
  // and it is as new: the same samples give the same bits
  monitor::MonitorCycle fresh(pristine);
  test::Flight again(test::made_up_design()->model, Eigen::VectorXd::Zero(10), 4);
  for (int i = 0; i < 200; ++i) {
    sample = again.next();
    used.process(sample);
    fresh.process(sample);
  }
  EXPECT_EQ(used.watch().filter().health(), fresh.watch().filter().health());
  EXPECT_EQ(used.counters().received, 200u);
}

// A fleet's memory is that of its engines: what one more of a design that is loaded already takes, with its latencies
// and counters. 7 sensors, 10 health parameters, 7 tuners; the shift detector's window is a fourth of it.
TEST(Memory, OneMoreEngineOfALoadedDesignTakes60kBAtMost) {
  const monitor::CycleOptions options;
  const monitor::PreparedDesign prepared(test::made_up_design(), options);
  const long before = test::allocated_bytes();
  const auto slot = std::make_unique<monitor::EngineSlot>(prepared, options);
  const long engine = test::allocated_bytes() - before;
  std::printf("one more engine of a loaded design: %.1f kB\n", 1e-3 * static_cast<double>(engine));
  EXPECT_LE(engine, 60'000);
  EXPECT_GT(engine, static_cast<long>(sizeof(monitor::EngineSlot)));
}

}  // namespace
