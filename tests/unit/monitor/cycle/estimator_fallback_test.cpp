// SPDX-License-Identifier: Apache-2.0
// A published estimator that has no answer: the watch filter's estimates in its place, and back again.

#include "monitor/cycle/estimator_fallback.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "monitor/cycle/monitor_cycle.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tests/unit/monitor/cycle/moody.h"

namespace {

using namespace ehm;
using monitor::EstimatorFallback;
using monitor::EventList;
using monitor::MonitorCycle;

int count(const EventList& events, bool raised) {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [&](const auto& e) {
    return e.kind == idl::EventKind::estimator_fallback && e.raised == raised;
  }));
}

TEST(EstimatorFallback, NeedsThreeInARowAndTwoHundredToReturn) {
  EstimatorFallback fallback;
  EventList events;
  EXPECT_FALSE(fallback.look(false, events));
  EXPECT_FALSE(fallback.look(false, events));
  EXPECT_FALSE(fallback.look(true, events));
  EXPECT_FALSE(fallback.look(false, events));
  EXPECT_FALSE(fallback.look(false, events));
  EXPECT_TRUE(fallback.look(false, events));
  EXPECT_EQ(count(events, true), 1);
  for (int k = 0; k < 199; ++k) EXPECT_TRUE(fallback.look(true, events));
  EXPECT_FALSE(fallback.look(true, events));
  EXPECT_EQ(count(events, false), 1);
}

TEST(EstimatorFallback, TheCyclePublishesTheWatchFilterMeanwhileAndSaysSo) {
  const auto answers = std::make_shared<bool>(true);
  monitor::PreparedDesign prepared(test::made_up_design());
  prepared.companions.push_back({"moody", std::make_shared<const test::Moody>(answers)});
  prepared.published = 0;
  MonitorCycle cycle(prepared, {});
  test::Flight flight(test::made_up_design()->model, Eigen::VectorXd::Zero(10), 3);
  EventList heard;
  const auto fly = [&](int samples) {
    for (int k = 0; k < samples; ++k) {
      cycle.clear_events();
      cycle.process(flight.next());
      for (const auto& event : cycle.events()) heard.push(event);
    }
  };
  fly(400);
  ASSERT_TRUE(cycle.result().estimates);
  EXPECT_EQ(cycle.result().estimate.health(0), 0.5);
  *answers = false;
  fly(2);
  EXPECT_FALSE(cycle.result().estimates);  // nothing is published that nobody has estimated
  fly(1);
  EXPECT_TRUE(cycle.result().estimates);
  EXPECT_TRUE(cycle.result().flags & idl::estimate_flag::fallback);
  EXPECT_EQ(cycle.result().estimate.health, cycle.watch().estimate().health);
  EXPECT_EQ(count(heard, true), 1);
  *answers = true;
  fly(199);
  EXPECT_TRUE(cycle.result().flags & idl::estimate_flag::fallback);
  fly(1);
  EXPECT_FALSE(cycle.result().flags & idl::estimate_flag::fallback);
  EXPECT_EQ(cycle.result().estimate.health(0), 0.5);
  EXPECT_EQ(count(heard, false), 1);
}

}  // namespace
