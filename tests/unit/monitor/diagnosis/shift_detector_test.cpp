// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/shift_detector.h"

#include <gtest/gtest.h>

#include "deploy/runtime/numbers/index.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

/// Events of kind health_shift in a flight of `after` samples following a change of one parameter.
std::vector<Event> shifts(std::size_t parameter, double change, int after, std::uint64_t seed) {
  const auto design = test::made_up_design();
  test::Flight flight(design->model, Eigen::VectorXd::Zero(10), seed);
  MonitorCycle cycle(design, CycleOptions{});
  std::vector<Event> found;
  for (int k = 0; k < 2000 + after; ++k) {
    if (k == 2000) {
      Eigen::VectorXd h = flight.health();
      h(as_index(parameter)) += change;
      flight.set_health(h);
    }
    cycle.process(flight.next());
    for (const Event& e : cycle.events())
      if (e.kind == idl::EventKind::health_shift) found.push_back(e);
    cycle.clear_events();
  }
  return found;
}

TEST(ShiftDetector, NamesTheParameterThatChanged) {
  for (std::size_t parameter : {0u, 4u, 7u}) {
    const auto found = shifts(parameter, -0.03, 250, 21);  // 3.75 s: still inside the window
    ASSERT_EQ(found.size(), 1u) << parameter;
    EXPECT_TRUE(found[0].raised);
    EXPECT_EQ(found[0].channel, parameter);
    EXPECT_LT(found[0].value, -0.01);
    EXPECT_GT(std::abs(found[0].value), found[0].threshold);
  }
}

TEST(ShiftDetector, ClearsWhenTheWindowHasPassed) {
  const auto found = shifts(4, -0.03, 2000, 22);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(found[1].raised);
  EXPECT_EQ(found[1].channel, 4u);
}

TEST(PreparedDesign, ItsTablesAreMadeOnceAndSharedByAllEngines) {
  const PreparedDesign prepared(test::made_up_design());
  const long owners[]{prepared.shift.use_count(), prepared.slow_bias.use_count()};
  std::vector<std::unique_ptr<MonitorCycle>> engines;
  for (int i = 0; i < 10; ++i) engines.push_back(std::make_unique<MonitorCycle>(prepared, CycleOptions{}));
  EXPECT_EQ(prepared.shift.use_count(), owners[0] + 10);
  EXPECT_EQ(prepared.slow_bias.use_count(), owners[1] + 10);
}

TEST(ShiftDetector, IsSilentOverAnHourOfNoise) {
  EXPECT_TRUE(shifts(0, 0.0, 240'000, 23).empty());
}

}  // namespace
