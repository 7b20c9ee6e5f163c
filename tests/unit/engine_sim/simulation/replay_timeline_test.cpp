// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/replay/replay_timeline.h"

#include <gtest/gtest.h>

namespace {

using namespace ehm;

constexpr std::int64_t ms = 1'000'000, s = 1'000'000'000;

recording::Row row(std::int64_t engine, std::int64_t source_time_ns, std::int64_t received_ns) {
  recording::Row r;
  r.a.unit = engine;
  r.a.source_time_ns = source_time_ns;
  r.a.received_ns = received_ns;
  return r;
}

TEST(ReplayTimeline, FollowsTheSourceClockHoweverFastItWasRecorded) {
  engine_sim::ReplayTimeline timeline;
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s, 5 * s)), 0);
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 15 * ms, 5 * s + ms)), 15 * ms);
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 45 * ms, 5 * s + 2 * ms)), 45 * ms);  // one was lost
}

TEST(ReplayTimeline, AClockThatStandsStepsOrJumpsYieldsToTheReceptions) {
  engine_sim::ReplayTimeline timeline;
  timeline.due_ns(row(1, 100 * s, 5 * s));
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s, 5 * s + 10 * ms)), 10 * ms);              // a duplicate
  EXPECT_EQ(timeline.due_ns(row(1, 20 * s, 5 * s + 30 * ms)), 30 * ms);               // set back
  EXPECT_EQ(timeline.due_ns(row(1, 9000 * s, 5 * s + 3030 * ms)), 3030 * ms);         // a pause
  EXPECT_EQ(timeline.due_ns(row(1, 9000 * s + 15 * ms, 5 * s + 9 * ms)), 3045 * ms);  // and on
  EXPECT_EQ(timeline.due_ns(row(1, 9000 * s + 15 * ms, 5 * s)), 3045 * ms);           // never back
}

TEST(ReplayTimeline, TheTicksOfACoarseClockLengthenNothing) {
  // Samples every 15 ms, stamped by a clock of 20 ms: 60 s of flight take 60 s, within one tick.
  engine_sim::ReplayTimeline timeline;
  std::int64_t due_ns = 0, before_ns = 0;
  for (std::int64_t k = 0; k <= 4000; ++k) {
    due_ns = timeline.due_ns(row(1, 100 * s + k * 15 / 20 * 20 * ms, 5 * s + k * 15 * ms));
    EXPECT_LE(due_ns - before_ns, 20 * ms);
    before_ns = due_ns;
  }
  EXPECT_NEAR(1e-9 * static_cast<double>(due_ns), 60.0, 0.02);
}

TEST(ReplayTimeline, AClockThatStoodAndGoesOnFromThereIsNotCaughtUp) {
  engine_sim::ReplayTimeline timeline;
  for (std::int64_t k = 0; k <= 100; ++k) timeline.due_ns(row(1, 100 * s, 5 * s + k * 15 * ms));
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 15 * ms, 5 * s + 1515 * ms)), 1500 * ms);
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 30 * ms, 5 * s + 1530 * ms)), 1515 * ms);
}

TEST(ReplayTimeline, StampsThatAreNotSetYieldToTheReceptions) {
  engine_sim::ReplayTimeline timeline;
  for (std::int64_t k = 0; k <= 200; ++k) EXPECT_EQ(timeline.due_ns(row(1, 0, 5 * s + k * 15 * ms)), k * 15 * ms);
}

TEST(ReplayTimeline, EnginesKeepTheirOrder) {
  engine_sim::ReplayTimeline timeline;
  timeline.due_ns(row(1, 100 * s, 5 * s));
  EXPECT_EQ(timeline.due_ns(row(2, 7 * s, 5 * s + 5 * ms)), 5 * ms);
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 15 * ms, 5 * s + 15 * ms)), 15 * ms);
  EXPECT_EQ(timeline.due_ns(row(2, 7 * s + 15 * ms, 5 * s + 20 * ms)), 20 * ms);
  EXPECT_EQ(timeline.due_ns(row(1, 100 * s + 16 * ms, 5 * s + 30 * ms)), 20 * ms);  // due before, sent after
}

}  // namespace
