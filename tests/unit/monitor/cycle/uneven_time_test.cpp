// SPDX-License-Identifier: Apache-2.0
// A whole flight by clocks and counters that are not perfect: the filter flies on, one event says what is wrong, and
// what is truly wrong is still found. Figures of the clocks: a PC's tick is 15.625 ms, an RTOS' 20 ms, an RTC's 1 s.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "idl/wire_values.h"
#include "monitor/checks/sample_check.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
using idl::EventKind;

constexpr std::int64_t start_ns = 1'700'000'000'000'000'000;  // of a clock that counts since 1970
constexpr std::int64_t ms = 1'000'000;

/// What a source's clock shows at sample k, `true_ns` after the start.
using Stamps = std::function<std::int64_t(std::uint64_t k, std::int64_t true_ns)>;

class UnevenTimeTest : public testing::Test {
 protected:
  UnevenTimeTest() {
    test::Random random(7);
    flight_.emplace(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)), 11);
    start_anew();
  }
  void start_anew() {
    cycle_.emplace(design_, CycleOptions{});
    reference_.emplace(design_, CycleOptions{});
    events_.clear();
  }
  /// The next sample, for a cycle that sees `spoil`ed ones, and for one that sees a perfect clock.
  template <class Spoil>
  void fly(int samples, Spoil spoil) {
    for (int i = 0; i < samples; ++i) {
      Sample s = flight_->next();
      s.source_time_ns += start_ns;
      reference_->process(s);
      reference_->clear_events();
      spoil(s);
      cycle_->process(s);
      for (const Event& e : cycle_->events()) events_.push_back(e);
      cycle_->clear_events();
    }
  }
  void fly_by(const Stamps& stamps, int samples) {
    fly(samples, [&](Sample& s) { s.source_time_ns = stamps(s.sequence, s.source_time_ns - start_ns); });
  }
  int count(EventKind kind, bool raised = true) const {
    return static_cast<int>(std::count_if(events_.begin(), events_.end(),
                                          [&](const Event& e) { return e.kind == kind && e.raised == raised; }));
  }
  const Event* first(EventKind kind) const {
    const auto found = std::find_if(events_.begin(), events_.end(), [&](const Event& e) { return e.kind == kind; });
    return found == events_.end() ? nullptr : &*found;
  }
  RestartReason restart_reason() const {
    const Event* e = first(EventKind::filter_restart);
    return e ? static_cast<RestartReason>(e->detail) : RestartReason{99};
  }
  /// Nothing was lost, restarted or withheld, and the estimates are those of a perfect clock, to the bit.
  void expect_as_with_a_perfect_clock() {
    const CycleCounters& c = cycle_->counters();
    EXPECT_EQ(c.processed, c.received);
    EXPECT_EQ(c.restarts + c.lost + c.withheld, 0u);
    EXPECT_EQ(cycle_->watch().filter().health(), reference_->watch().filter().health());
    EXPECT_EQ(cycle_->watch().error().health_sigma(), reference_->watch().error().health_sigma());
  }
  void expect_said_once(StampState why) {
    ASSERT_EQ(events_.size(), 1u);
    EXPECT_EQ(events_[0].kind, EventKind::source_stamps);
    EXPECT_EQ(events_[0].detail, static_cast<std::uint32_t>(why));
    EXPECT_TRUE(cycle_->intake().order_troubled());
  }

  std::shared_ptr<const design::Design> design_ = test::made_up_design();
  std::optional<test::Flight> flight_;
  std::optional<MonitorCycle> cycle_, reference_;
  std::vector<Event> events_;
};

TEST_F(UnevenTimeTest, CoarseClocks) {
  for (const double tick_ms : {15.625, 20.0, 1000.0}) {
    const auto tick_ns = static_cast<std::int64_t>(tick_ms * 1e6);
    start_anew();
    fly_by([&](auto, std::int64_t true_ns) { return start_ns + true_ns / tick_ns * tick_ns; }, 5000);
    SCOPED_TRACE(tick_ms);
    expect_as_with_a_perfect_clock();
    expect_said_once(StampState::repeated);
  }
}

TEST_F(UnevenTimeTest, StampsThatAreNeverSet) {
  fly_by([](auto, auto) { return 0; }, 30000);
  expect_as_with_a_perfect_clock();
  expect_said_once(StampState::unset);
}

TEST_F(UnevenTimeTest, StampsThatNeverMove) {
  fly_by([](auto, auto) { return start_ns; }, 30000);
  expect_as_with_a_perfect_clock();
  expect_said_once(StampState::repeated);
}

TEST_F(UnevenTimeTest, StampsThatAreNotSetNowAndThenOrUntilTheClockKnowsTheTime) {
  fly_by([](auto k, std::int64_t t) { return k < 1000 || k % 10 == 3 ? 0 : start_ns + t; }, 5000);
  expect_as_with_a_perfect_clock();
  expect_said_once(StampState::unset);
}

TEST_F(UnevenTimeTest, JitterOfEightMilliseconds) {
  // Each stamp up to 8 ms off either way: two in a row may change their order by 1 ms, one pair in 500 does.
  test::Random random(3);
  fly_by(
      [&](auto, std::int64_t t) {
        return start_ns + t + static_cast<std::int64_t>(8e6 * std::tanh(random.normal_vector(1)(0)));
      },
      10000);
  expect_as_with_a_perfect_clock();
  EXPECT_GE(count(EventKind::source_stamps), 1);
  EXPECT_LE(count(EventKind::source_stamps), 4);  // in 150 s: calms of 10, 20, 40 s
  EXPECT_EQ(first(EventKind::source_stamps)->detail, static_cast<std::uint32_t>(StampState::set_back));
}

TEST_F(UnevenTimeTest, AStepOfNtpAndALeapSecondAreSaidAndOver) {
  for (const std::int64_t step_ns : {20 * ms, 1000 * ms}) {
    start_anew();
    const std::uint64_t at = flight_->next().sequence + 500;
    fly_by([&](auto k, std::int64_t t) { return start_ns + t - (k >= at ? step_ns : 0); }, 2000);
    SCOPED_TRACE(step_ns);
    expect_as_with_a_perfect_clock();
    EXPECT_EQ(count(EventKind::source_stamps, true), 1);
    EXPECT_EQ(count(EventKind::source_stamps, false), 1);
    EXPECT_NEAR(first(EventKind::source_stamps)->value, 0.015 - 1e-9 * static_cast<double>(step_ns), 1e-9);
    EXPECT_FALSE(cycle_->intake().order_troubled());
  }
}

TEST_F(UnevenTimeTest, AClockThatStoodAndCatchesUpIsNoGap) {
  fly_by([](auto k, std::int64_t t) { return start_ns + (k >= 500 && k < 1500 ? 7500 * ms : t); }, 2000);  // for 15 s
  expect_as_with_a_perfect_clock();
}

TEST_F(UnevenTimeTest, AnotherRateIsStillRefusedWhateverTheTick) {
  fly_by([](auto, std::int64_t t) { return start_ns + (t * 5 / 4) / (20 * ms) * (20 * ms); }, 3000);
  EXPECT_EQ(count(EventKind::sample_time), 1);
  EXPECT_FALSE(cycle_->result().estimates);
}

TEST_F(UnevenTimeTest, CountersThatWrapFlyOn) {
  for (const int bits : {8, 16}) {
    start_anew();
    const std::uint64_t first_sequence = flight_->next().sequence + 1;
    fly(2000, [&](Sample& s) { s.sequence = (s.sequence - first_sequence + 65000) % (std::uint64_t{1} << bits); });
    SCOPED_TRACE(bits);
    expect_as_with_a_perfect_clock();
    EXPECT_TRUE(events_.empty());
  }
}

TEST_F(UnevenTimeTest, NeitherStampsNorMoreThanEightBits) {
  fly(5000, [](Sample& s) {
    s.source_time_ns = 0;
    s.sequence %= 256;
  });
  expect_as_with_a_perfect_clock();
  expect_said_once(StampState::unset);
}

TEST_F(UnevenTimeTest, SamplesLostAcrossTheWrapArePredictedOver) {
  const auto eight_bits = [](Sample& s) { s.sequence %= 256; };
  fly(250, eight_bits);
  for (int i = 0; i < 10; ++i) flight_->next();  // 250 to 259
  fly(500, eight_bits);
  EXPECT_EQ(cycle_->counters().lost, 10u);
  EXPECT_EQ(cycle_->counters().restarts, 0u);
  EXPECT_EQ(cycle_->watch().filter().health(), reference_->watch().filter().health());  // it lost the same ten
}

TEST_F(UnevenTimeTest, ASequenceThatStandsStillIsNamedAndIsNoLossOfInput) {
  fly(500, [](Sample&) {});
  fly(100, [](Sample& s) { s.sequence = 499; });
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(events_[0].kind, EventKind::source_sequence);
  EXPECT_TRUE(cycle_->intake().sequence_stands());
  EXPECT_EQ(cycle_->counters().duplicated, 100u);
  fly(200, [](Sample&) {});
  EXPECT_FALSE(cycle_->intake().sequence_stands());
  EXPECT_EQ(count(EventKind::source_sequence, false), 1);
  EXPECT_EQ(count(EventKind::filter_restart), 0);  // 1.5 s are bridged
}

TEST_F(UnevenTimeTest, LostInputTellsWhatCameInstead) {
  fly(500, [](Sample&) {});
  Sample malformed = flight_->next();
  malformed.sensor_count = 3;
  cycle_->process(malformed);
  cycle_->no_input(0.05);
  ASSERT_EQ(cycle_->events().size(), 1u);
  EXPECT_EQ(cycle_->events().begin()->detail, 1u << static_cast<unsigned>(SampleVerdict::malformed));
  cycle_->clear_events();
  fly(1, [](Sample&) {});
  cycle_->no_input(0.05);
  EXPECT_EQ(cycle_->events().begin()->detail, 0u);  // nothing at all
}

TEST_F(UnevenTimeTest, EachRestartTellsItsReason) {
  const auto reason_of = [&](const std::function<void(Sample&)>& spoil) {
    start_anew();
    fly(500, [](Sample&) {});
    events_.clear();
    fly(1, spoil);
    EXPECT_EQ(count(EventKind::filter_restart), 1);
    return restart_reason();
  };
  EXPECT_EQ(reason_of([](Sample& s) { s.sequence = 0; }), RestartReason::source_restarted);
  EXPECT_EQ(reason_of([](Sample& s) { s.source_time_ns -= 5000 * ms; }), RestartReason::time_back);
  EXPECT_EQ(reason_of([](Sample& s) { s.source_time_ns += 5000 * ms; }), RestartReason::time_ahead);
  EXPECT_EQ(reason_of([](Sample& s) {
              s.sequence += 300;
              s.source_time_ns += 4500 * ms;
            }),
            RestartReason::gap);
  EXPECT_EQ(reason_of([](Sample& s) { s.sequence += 1'000'000; }), RestartReason::sequence_jump);
  cycle_->reset();
  EXPECT_EQ(cycle_->events().begin()->detail, static_cast<std::uint32_t>(RestartReason::command));
  cycle_->clear_events();
  cycle_->reset(RestartReason::other_design);
  EXPECT_EQ(cycle_->events().begin()->detail, static_cast<std::uint32_t>(RestartReason::other_design));
}

}  // namespace
