// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <thread>

#include "monitor/data/events.h"
#include "monitor/realtime/latency_histogram.h"
#include "monitor/realtime/spsc_queue.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

TEST(LatencyHistogram, PercentilesAreWithinABucketOfTheTruth) {
  LatencyHistogram h;
  for (int us = 1; us <= 1000; ++us) h.record(us);
  EXPECT_NEAR(h.percentile_us(0.50), 500.0, 0.045 * 500.0);
  EXPECT_NEAR(h.percentile_us(0.99), 990.0, 0.045 * 990.0);
  EXPECT_DOUBLE_EQ(h.max_us(), 1000.0);
  EXPECT_EQ(h.total(), 1000u);
}

TEST(LatencyHistogram, EmptyAndExtremeValues) {
  LatencyHistogram h;
  EXPECT_DOUBLE_EQ(h.percentile_us(0.5), 0.0);
  h.record(-3.0);
  h.record(1e12);
  EXPECT_DOUBLE_EQ(h.max_us(), 1e12);
  EXPECT_EQ(h.total(), 2u);
}

TEST(SpscQueue, RefusesAndCountsWhenFull) {
  SpscQueue<int, 4> q;
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(q.push(i));
  EXPECT_FALSE(q.push(4));
  EXPECT_EQ(q.overflow(), 1u);
  int value = -1;
  EXPECT_TRUE(q.pop(value));
  EXPECT_EQ(value, 0);
  EXPECT_TRUE(q.push(5));
}

TEST(SpscQueue, KeepsOrderBetweenTwoThreads) {
  constexpr int count = 100'000;
  SpscQueue<int, 64> q;
  std::thread producer([&] {
    for (int i = 0; i < count;) i += q.push(i);
  });
  for (int expected = 0; expected < count;) {
    int value = -1;
    if (!q.pop(value)) continue;
    ASSERT_EQ(value, expected);
    ++expected;
  }
  producer.join();
}

TEST(EventList, CountsWhatDoesNotFit) {
  EventList events;
  for (int i = 0; i < 70; ++i) events.push({idl::EventKind::sensor_fault, 0, true, 0.0, 0.0, 0});
  EXPECT_EQ(events.size(), 64u);
  EXPECT_EQ(events.overflow(), 6u);
  EXPECT_EQ(events.raised_total(), 70u);
}

TEST(Condition, SaysOnlyChanges) {
  EventList events;
  Condition c;
  c.set(false, {}, events);
  c.set(true, {}, events);
  c.set(true, {}, events);
  c.set(false, {}, events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_TRUE(events.begin()->raised);
  EXPECT_FALSE((events.begin() + 1)->raised);
}

}  // namespace
