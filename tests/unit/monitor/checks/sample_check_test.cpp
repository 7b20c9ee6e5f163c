// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/sample_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "monitor/checks/sample_time_watch.h"
#include "monitor/checks/second_source_watch.h"

namespace {

using namespace ehm::monitor;

constexpr double sample_time_s = 0.015;

Sample sample(std::uint64_t sequence, double time_s) {
  Sample s;
  s.schema = 1;
  s.sequence = sequence;
  s.source_time_ns = static_cast<std::int64_t>(std::llround(time_s * 1e9));
  s.sensor_count = 7;
  s.actuator_count = 1;
  return s;
}

SampleCheck check() {
  return SampleCheck(CheckOptions{}, 7, 1, sample_time_s);
}

TEST(SampleCheck, AcceptsSamplesInOrder) {
  SampleCheck c = check();
  EXPECT_EQ(c.decide(sample(0, 0.0)).verdict, SampleVerdict::first);
  const auto next = c.decide(sample(1, 0.015));
  EXPECT_EQ(next.verdict, SampleVerdict::accepted);
  EXPECT_EQ(next.steps, 1);
  EXPECT_EQ(next.lost, 0u);
}

TEST(SampleCheck, CountsTheSamplesOfAGapAndPredictsOverThem) {
  SampleCheck c = check();
  c.decide(sample(10, 0.0));
  const auto d = c.decide(sample(14, 4 * sample_time_s));
  EXPECT_EQ(d.verdict, SampleVerdict::accepted);
  EXPECT_EQ(d.lost, 3u);
  EXPECT_EQ(d.steps, 4);
}

TEST(SampleCheck, DropsDuplicatesAndOvertakenSamples) {
  SampleCheck c = check();
  c.decide(sample(5, 1.0));
  c.decide(sample(6, 1.015));
  EXPECT_EQ(c.decide(sample(6, 1.015)).verdict, SampleVerdict::duplicate);
  EXPECT_EQ(c.decide(sample(5, 1.0)).verdict, SampleVerdict::reordered);
  EXPECT_EQ(c.decide(sample(7, 1.03)).verdict, SampleVerdict::accepted);
}

TEST(SampleCheck, RestartsWhenTheSourceStartedAnew) {
  SampleCheck c = check();
  c.decide(sample(1000, 15.0));
  const auto d = c.decide(sample(0, 15.2));  // number falls, clock goes on
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.lost, 0u);
}

TEST(SampleCheck, RestartsWhenTimeJumpsBackwards) {
  SampleCheck c = check();
  c.decide(sample(1000, 100.0));
  const auto d = c.decide(sample(1001, 50.0));
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_NEAR(d.jump_s, -50.0, 1e-9);
}

TEST(SampleCheck, AClockThatIsSetBackALittleDoesNotRestart) {
  SampleCheck c = check();
  c.decide(sample(1000, 100.0));
  const auto d = c.decide(sample(1001, 99.5));
  EXPECT_EQ(d.verdict, SampleVerdict::accepted);
  EXPECT_EQ(d.steps, 1);
  EXPECT_EQ(d.stamp, StampState::set_back);
  EXPECT_EQ(c.decide(sample(1002, 99.515)).stamp, StampState::good);
}

TEST(SampleCheck, FollowsOneSourceUntilItIsReleased) {
  SampleCheck c = check();
  Sample a = sample(0, 0.0), b = sample(0, 0.0);
  a.source_id = 1;
  b.source_id = 2;
  EXPECT_EQ(c.decide(a).verdict, SampleVerdict::first);
  EXPECT_EQ(c.decide(b).verdict, SampleVerdict::foreign);
  c.release_source();
  b.sequence = 1;
  b.source_time_ns = 15'000'000;
  EXPECT_EQ(c.decide(b).verdict, SampleVerdict::accepted);
}

TEST(SampleCheck, FollowsOnlyTheSourceThatIsNamed) {
  CheckOptions options;
  options.source_id = 2;
  SampleCheck c(options, 7, 1, sample_time_s);
  Sample stranger = sample(0, 0.0), named = sample(0, 0.0);
  stranger.source_id = 1;
  stranger.writer = 10;
  named.source_id = 2;
  named.writer = 20;
  EXPECT_EQ(c.decide(stranger).verdict, SampleVerdict::foreign);  // though nobody else has spoken
  EXPECT_EQ(c.source_id(), 2u);
  EXPECT_EQ(c.decide(named).verdict, SampleVerdict::first);
  c.release_source();
  stranger = sample(1, 0.015);
  stranger.source_id = 1;
  EXPECT_EQ(c.decide(stranger).verdict, SampleVerdict::foreign);
  named = sample(1, 0.015);
  named.source_id = 2;
  named.writer = 21;  // started anew by its supervisor
  EXPECT_EQ(c.decide(named).verdict, SampleVerdict::accepted);
}

TEST(SampleCheck, TellsWritersWithTheSameSourceIdApart) {
  SampleCheck c = check();
  Sample a = sample(0, 0.0), b = sample(1, 0.015);
  a.writer = 1;
  b.writer = 2;
  EXPECT_EQ(c.decide(a).verdict, SampleVerdict::first);
  EXPECT_EQ(c.decide(b).verdict, SampleVerdict::foreign);
  b.writer = 0;  // who wrote it is not known, as in a recording of another make
  EXPECT_EQ(c.decide(b).verdict, SampleVerdict::accepted);
  c.release_source();
  b = sample(2, 0.03);
  b.writer = 2;
  EXPECT_EQ(c.decide(b).verdict, SampleVerdict::accepted);
  a = sample(3, 0.045);
  a.writer = 1;
  EXPECT_EQ(c.decide(a).verdict, SampleVerdict::foreign);
}

TEST(SampleCheck, StampsAtTheEndsOfTheirRangeRestart) {
  constexpr auto latest = std::numeric_limits<std::int64_t>::max(), earliest = std::numeric_limits<std::int64_t>::min();
  SampleCheck c = check();
  c.decide(sample(0, 1.0));
  Sample s = sample(1, 0.0);
  s.source_time_ns = latest;
  auto d = c.decide(s);
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_NEAR(d.jump_s, 9.223e9, 1e6);
  s.source_time_ns = earliest;  // 584 years back: more than an int64_t of nanoseconds holds
  s.sequence = 2;
  d = c.decide(s);
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_NEAR(d.jump_s, -9.223e9, 1e6);
}

TEST(SampleCheck, ASequenceThatTimeDoesNotExplainIsNoLoss) {
  SampleCheck c = check();
  c.decide(sample(10, 0.0));
  auto d = c.decide(sample(1'000'000'000'000, sample_time_s));
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.lost, 0u);
  d = c.decide(sample(~std::uint64_t{0}, 10.0));  // neither is it after ten seconds
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.lost, 0u);
}

TEST(SampleTimeWatch, OneStepOfTheSourcesClockDoesNotMatterAnotherRateDoes) {
  SampleTimeWatch watch(sample_time_s);
  EventList events;
  SampleDecision d{SampleVerdict::accepted, 1, 0, 0.0, sample_time_s};
  for (int i = 0; i < 128; ++i) {
    d.dt_s = i == 20 ? 1.9 : sample_time_s;
    EXPECT_TRUE(watch.check(d, events)) << i;
  }
  d.dt_s = 1.2 * sample_time_s;
  for (int i = 0; i < 128; ++i) watch.check(d, events);
  EXPECT_FALSE(watch.check(d, events));
  EXPECT_EQ(events.size(), 1u);
}

TEST(SampleTimeWatch, ASourceThatWasHeldUpAndCatchesUpKeepsItsRate) {
  // Stamped when they were measured by a process that the machine pauses for 0.12 s now and then: seven samples at
  // once.
  SampleTimeWatch watch(sample_time_s);
  EventList events;
  SampleDecision d{SampleVerdict::accepted, 1, 0, 0.0, sample_time_s};
  for (int i = 0; i < 640; ++i) {
    const int place = i % 40;
    d.dt_s = place == 10 ? 8.0 * sample_time_s - 7e-4 : place > 10 && place <= 17 ? 1e-4 : sample_time_s;
    EXPECT_TRUE(watch.check(d, events)) << i;
  }
  EXPECT_EQ(events.size(), 0u);
}

TEST(SecondSourceWatch, CountsSecondsNotSamples) {
  SecondSourceWatch slow(0.1);  // 3 s are 30 sample times
  EventList events;
  Sample other;
  slow.foreign(other, 1, events);
  for (int i = 0; i < 9; ++i) slow.followed(3, events);  // two of three are lost
  EXPECT_EQ(events.size(), 1u);
  slow.followed(3, events);
  EXPECT_EQ(events.size(), 2u);
}

TEST(SecondSourceWatch, SaysOnceAndEndsWhenTheOtherIsQuiet) {
  SecondSourceWatch watch(sample_time_s);
  EventList events;
  Sample other;
  other.source_id = 2;
  for (int i = 0; i < 5; ++i) watch.foreign(other, 1, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.begin()->value, 2.0);
  EXPECT_EQ(events.begin()->threshold, 1.0);
  for (int i = 0; i < 199; ++i) watch.followed(1, events);
  watch.foreign(other, 1, events);
  for (int i = 0; i < 199; ++i) watch.followed(1, events);
  EXPECT_EQ(events.size(), 1u);
  watch.followed(1, events);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_FALSE((events.begin() + 1)->raised);
}

TEST(SampleCheck, RestartsAfterAGapLongerThanAllowedAndStillCountsIt) {
  SampleCheck c = check();
  c.decide(sample(0, 0.0));
  const auto d = c.decide(sample(201, 201 * sample_time_s));  // 3 s, 2 s are allowed
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.lost, 200u);
}

TEST(SampleCheck, RefusesWrongSchemaAndCounts) {
  auto expect_malformed = [](Sample s) {
    SampleCheck c = check();
    EXPECT_EQ(c.decide(s).verdict, SampleVerdict::malformed);
  };
  Sample s = sample(0, 0.0);
  s.schema = 2;
  expect_malformed(s);
  s = sample(0, 0.0);
  s.sensor_count = 6;
  expect_malformed(s);
  s = sample(0, 0.0);
  s.actuator_count = 0;
  expect_malformed(s);
}

TEST(SampleCheck, ABadWordOfFlightOrActuatorsIsNotItsToRefuse) {
  SampleCheck c = check();
  Sample s = sample(0, 0.0);
  s.flight.mach = std::numeric_limits<double>::quiet_NaN();
  s.actuator[0] = std::numeric_limits<double>::infinity();
  EXPECT_EQ(c.decide(s).verdict, SampleVerdict::first);
}

TEST(SampleCheck, IgnoresEntriesBeyondTheCounts) {
  SampleCheck c = check();
  Sample s = sample(0, 0.0);
  s.actuator[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(c.decide(s).verdict, SampleVerdict::first);
}

}  // namespace
