// SPDX-License-Identifier: Apache-2.0
// What the impairing re-publisher does to samples: every one is accounted for, and a seed repeats its fate.

#include "tests/tools/impair/impairment.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/temporary_folder.h"
#include "tests/tools/impair/control.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;

constexpr double sample_time_s = 0.015;

EngineSensors sample(std::uint64_t sequence) {
  EngineSensors s;
  s.sequence_number(sequence);
  s.sensor_count(7);
  s.sensor().fill(1.0);
  return s;
}

/// Sends `count` samples at 15 ms through the impairment; what comes out, in order.
std::vector<std::uint64_t> pass(Impairment& impairment, std::uint64_t count) {
  std::vector<std::uint64_t> out;
  const auto take = [&](double now_s) {
    while (const auto s = impairment.send(now_s)) out.push_back(s->sequence_number());
  };
  for (std::uint64_t i = 0; i < count; ++i) {
    const double now_s = sample_time_s * static_cast<double>(i);
    impairment.receive(sample(i), now_s);
    take(now_s);
  }
  take(1e9);
  return out;
}

TEST(Impairment, WithoutSettingsEverythingPassesInOrder) {
  Impairment impairment(1);
  const auto out = pass(impairment, 100);
  ASSERT_EQ(out.size(), 100u);
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
}

TEST(Impairment, EverySampleIsAccountedForAndTheSeedRepeatsItsFate) {
  const auto fate = [](std::uint64_t seed, ImpairmentCounters& counters) {
    Impairment impairment(seed);
    impairment.settings.loss = 0.2;
    impairment.settings.duplicate = 0.1;
    impairment.settings.jitter_ms = 50.0;
    const auto out = pass(impairment, 10'000);
    counters = impairment.counters();
    return out;
  };
  ImpairmentCounters c, again;
  const auto out = fate(7, c);
  EXPECT_EQ(out, fate(7, again));
  EXPECT_NE(out, fate(8, again));
  EXPECT_EQ(c.received, 10'000u);
  EXPECT_EQ(c.received + c.duplicated, c.sent + c.dropped);
  EXPECT_EQ(c.sent, out.size());
  // Binomial: 2000 +- 40 and 800 (of those that pass) +- 27; five sigma.
  EXPECT_NEAR(static_cast<double>(c.dropped), 2000.0, 200.0);
  EXPECT_NEAR(static_cast<double>(c.duplicated), 800.0, 135.0);
  EXPECT_FALSE(std::is_sorted(out.begin(), out.end()));  // 50 ms of jitter at 15 ms spacing overtakes
}

TEST(Impairment, OrderedKeepsTheOrderUnderJitter) {
  Impairment impairment(3);
  impairment.settings.jitter_ms = 50.0;
  impairment.settings.ordered = 1.0;
  const auto out = pass(impairment, 1000);
  EXPECT_EQ(out.size(), 1000u);
  EXPECT_TRUE(std::is_sorted(out.begin(), out.end()));
}

TEST(Impairment, PauseHoldsAndThenSendsAllAndCutDrops) {
  Impairment impairment(1);
  obey("pause 0.5", 0.0, impairment);
  for (std::uint64_t i = 0; i < 10; ++i) impairment.receive(sample(i), 0.01 * static_cast<double>(i));
  EXPECT_FALSE(impairment.send(0.49));
  for (std::uint64_t i = 0; i < 10; ++i) {
    const auto s = impairment.send(0.5);
    ASSERT_TRUE(s);
    EXPECT_EQ(s->sequence_number(), i);
  }
  obey("cut 1", 1.0, impairment);
  impairment.receive(sample(10), 1.5);
  EXPECT_FALSE(impairment.send(9.0));
  EXPECT_EQ(impairment.counters().dropped, 1u);
  impairment.receive(sample(11), 2.0);
  EXPECT_TRUE(impairment.send(2.0));
}

TEST(Impairment, NanAndBitFlipsSpoilOneSensor) {
  Impairment impairment(1);
  impairment.settings.nan = 1.0;
  impairment.receive(sample(0), 0.0);
  const auto s = impairment.send(0.0);
  EXPECT_EQ(std::count_if(s->sensor().begin(), s->sensor().end(), [](double y) { return std::isnan(y); }), 1);
  impairment.settings = {};
  impairment.settings.bit_flip = 1.0;
  impairment.receive(sample(1), 0.0);
  const auto t = impairment.send(0.0);
  EXPECT_EQ(std::count_if(t->sensor().begin(), t->sensor().end(), [](double y) { return y != 1.0; }), 1);
}

TEST(ImpairmentControl, SetsClearsAndRefusesWithTheAllowedRange) {
  Impairment impairment(1);
  obey("loss 0.2", 0.0, impairment);
  obey("  # a remark", 0.0, impairment);
  obey("clock_offset_s -3600", 0.0, impairment);
  EXPECT_EQ(impairment.settings.loss, 0.2);
  EXPECT_EQ(impairment.settings.clock_offset_s, -3600.0);
  const auto refusal = [&](const std::string& line) -> std::string {
    try {
      obey(line, 0.0, impairment);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_THAT(refusal("loss 2"), HasSubstr("'loss 2': allowed is a number from 0 to 1"));
  EXPECT_THAT(refusal("loss"), HasSubstr("a name and a number"));
  EXPECT_THAT(refusal("los 0.1"), HasSubstr("allowed are pause, cut, clear, loss"));
  EXPECT_EQ(impairment.settings.loss, 0.2);
  obey("clear 0", 0.0, impairment);
  EXPECT_EQ(impairment.settings.loss, 0.0);
}

TEST(ImpairmentControl, AScheduleActsAtItsTimesAndNamesItsBadLines) {
  const TemporaryFolder folder;
  Schedule schedule(folder.file("s.txt", "# network\n1 loss 0.5\n2.5 loss 0\n"));
  Impairment impairment(1);
  schedule.run(0.9, 0.0, impairment);
  EXPECT_EQ(impairment.settings.loss, 0.0);
  schedule.run(1.0, 0.0, impairment);
  EXPECT_EQ(impairment.settings.loss, 0.5);
  schedule.run(9.0, 0.0, impairment);
  EXPECT_EQ(impairment.settings.loss, 0.0);
  const std::string bad = folder.file("bad.txt", "1 loss 0.5\n0.5 loss 0\n");
  try {
    Schedule refused(bad);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& e) {
    EXPECT_THAT(e.what(), HasSubstr(bad + ":2: "));
    EXPECT_THAT(e.what(), HasSubstr("backwards"));
  }
}

}  // namespace
