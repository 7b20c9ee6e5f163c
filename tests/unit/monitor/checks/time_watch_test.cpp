// SPDX-License-Identifier: Apache-2.0
// Stamps and numbers that are not perfect: what is said of them, and how often.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/sequence_watch.h"
#include "monitor/checks/source_clock.h"
#include "monitor/checks/stamp_watch.h"

namespace {

using namespace ehm::monitor;
using ehm::idl::EventKind;

constexpr double sample_time_s = 0.015;

SampleDecision accepted(double dt_s, StampState stamp = StampState::good) {
  return {SampleVerdict::accepted, 1, 0, 0.0, dt_s, stamp};
}

TEST(SourceClock, TellsAcrossStampsThatAreNotSetOrRepeat) {
  SourceClock clock;
  clock.start(1'000'000'000);
  EXPECT_EQ(clock.elapsed(0).state, StampState::unset);
  clock.advance(0, 1);
  EXPECT_EQ(clock.elapsed(1'000'000'000).state, StampState::repeated);
  clock.advance(1'000'000'000, 1);
  const Elapsed e = clock.elapsed(1'045'000'000);
  EXPECT_TRUE(e.told);
  EXPECT_NEAR(e.dt_s, 0.045, 1e-12);
  EXPECT_EQ(e.stood, 2.0);
  EXPECT_TRUE(e.fits(1.0, sample_time_s));
  EXPECT_FALSE(e.fits(6.0, sample_time_s));  // 75 ms more
}

TEST(SourceClock, TheFirstStampThatIsSetMeasuresNothing) {
  SourceClock clock;
  clock.start(0);
  clock.advance(0, 5);
  const Elapsed e = clock.elapsed(1'700'000'000'000'000'000);  // now it knows the time: no gap of 54 years
  EXPECT_FALSE(e.told);
  EXPECT_EQ(e.state, StampState::good);
}

/// Mean of dt / steps of a clock that shows floor(t / tick) tick, by SampleTimeWatch; every sample `period_s`.
int sample_time_events(double tick_s, double period_s, int samples) {
  SampleTimeWatch watch(sample_time_s);
  EventList events;
  double last_s = 0.0;
  for (int k = 1; k <= samples; ++k) {
    const double shown_s = tick_s * std::floor(k * period_s / tick_s);
    watch.check(accepted(shown_s - last_s), events);
    last_s = shown_s;
  }
  return static_cast<int>(events.size());
}

TEST(SampleTimeWatch, ACoarseClockKeepsTheRateAnotherRateDoesNot) {
  for (const double tick_s : {0.001, 0.015625, 0.02, 0.1, 0.25, 1.0, 3.0}) {
    EXPECT_EQ(sample_time_events(tick_s, 0.015, 20000), 0) << tick_s;
    EXPECT_EQ(sample_time_events(tick_s, 0.018, 20000), 1) << tick_s;
    EXPECT_EQ(sample_time_events(tick_s, 0.0125, 20000), 1) << tick_s;
  }
}

TEST(SampleTimeWatch, StampsThatStandStillTellNothing) {
  SampleTimeWatch watch(sample_time_s);
  EventList events;
  for (int k = 0; k < 1'000'000; ++k) ASSERT_TRUE(watch.check(accepted(0.0, StampState::unset), events)) << k;
  EXPECT_EQ(events.size(), 0u);
}

TEST(SampleTimeWatch, WhatWasSaidIsTakenBackOnceNothingIsMeasured) {
  SampleTimeWatch watch(sample_time_s);
  EventList events;
  for (int k = 0; k < 128; ++k) watch.check(accepted(0.03), events);
  ASSERT_EQ(events.size(), 1u);
  for (int k = 0; k < 8191; ++k) EXPECT_FALSE(watch.check(accepted(0.0), events));
  EXPECT_TRUE(watch.check(accepted(0.0), events));
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ((events.begin() + 1)->detail, SampleTimeWatch::not_measured);
}

TEST(StampWatch, SaysOnceWithTheReasonAndEndsAfterTenGoodSeconds) {
  StampWatch watch(sample_time_s);
  EventList events;
  for (int k = 0; k < 1000; ++k) watch.check(accepted(0.0, StampState::unset), events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.begin()->kind, EventKind::source_stamps);
  EXPECT_EQ(events.begin()->detail, static_cast<std::uint32_t>(StampState::unset));
  for (int k = 0; k < 666; ++k) watch.check(accepted(0.015), events);
  EXPECT_TRUE(watch.raised());
  watch.check(accepted(0.015), events);
  EXPECT_FALSE(watch.raised());
  EXPECT_EQ(events.size(), 2u);
}

TEST(StampWatch, AClockThatRepeatsNowAndThenDoesNotFillTheLog) {
  // A tick of 15.01 ms repeats a stamp every 22.5 s. In ten hours, 1600 repetitions make few events.
  StampWatch watch(sample_time_s);
  EventList events;
  std::size_t said = 0;
  for (int k = 1; k <= 2'400'000; ++k) {
    watch.check(k % 1501 == 0 ? accepted(0.0, StampState::repeated) : accepted(0.01501), events);
    said += events.size();
    events.clear();
  }
  EXPECT_EQ(said, 5u);  // raised and cleared with a calm of 10 and 20 s, then raised for good: 40 s is more than 22.5
}

Sample sample(std::uint64_t sequence, std::int64_t time_ns, double value) {
  Sample s;
  s.sequence = sequence;
  s.source_time_ns = time_ns;
  s.sensor[0] = value;
  return s;
}

TEST(SequenceWatch, ADuplicateIsNoNumberThatStands) {
  SequenceWatch watch(sample_time_s);
  EventList events;
  const Sample s = sample(5, 100, 1.0);
  watch.in_order(s, events);
  for (int k = 0; k < 10; ++k) watch.repeated(s, events);
  EXPECT_EQ(events.size(), 0u);
}

TEST(SequenceWatch, NewSamplesUnderOneNumberAreSaidOnceUntilASecondIsGood) {
  SequenceWatch watch(sample_time_s);
  EventList events;
  watch.in_order(sample(5, 100, 1.0), events);
  watch.repeated(sample(5, 200, 1.0), events);
  EXPECT_EQ(events.size(), 0u);
  watch.repeated(sample(5, 200, 2.0), events);  // no stamp, other values
  for (int k = 3; k < 50; ++k) watch.repeated(sample(5, 100 * k, 1.0), events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.begin()->kind, EventKind::source_sequence);
  EXPECT_EQ(events.begin()->value, 5.0);
  EXPECT_TRUE(watch.standing());
  watch.in_order(sample(6, 9000, 1.0), events);
  EXPECT_FALSE(watch.standing());
  EXPECT_TRUE(watch.raised());
  for (int k = 0; k < 66; ++k) watch.in_order(sample(7, 9000 + k, 1.0), events);  // ceil(1 s / 15 ms) = 67 in all
  EXPECT_FALSE(watch.raised());
  EXPECT_EQ(events.size(), 2u);
}

}  // namespace
