// SPDX-License-Identifier: Apache-2.0
// Counters that wrap before 2^64, told from sources that start anew and from samples that were overtaken.

#include "monitor/checks/sequence_order.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monitor/checks/sample_check.h"

namespace {

using namespace ehm::monitor;

constexpr double sample_time_s = 0.015;

/// One sample after another; time in sample times, as the source's clock shows it.
class WideSequence : public testing::Test {
 protected:
  SampleDecision send(std::uint64_t sequence, double time) {
    return send_stamped(sequence, 1'000'000'000'000 + std::llround(1e9 * sample_time_s * time));
  }
  SampleDecision send_stamped(std::uint64_t sequence, std::int64_t time_ns) {
    Sample s;
    s.schema = 1;
    s.sequence = sequence;
    s.source_time_ns = time_ns;
    return check_.decide(s);
  }
  SampleCheck check_{CheckOptions{}, 0, 0, sample_time_s};
};

/// Of a counter of so many bits.
class SequenceTest : public WideSequence, public testing::WithParamInterface<int> {
 protected:
  std::uint64_t turn() const { return std::uint64_t{1} << GetParam(); }
};

TEST_P(SequenceTest, AWrapIsTheNextSample) {
  for (int k = -20; k < 20; ++k) {
    const auto d = send(static_cast<std::uint64_t>(static_cast<std::int64_t>(turn()) + k) % turn(), k);
    EXPECT_EQ(d.verdict, k == -20 ? SampleVerdict::first : SampleVerdict::accepted) << k;
    EXPECT_EQ(d.lost, 0u);
    EXPECT_EQ(d.steps, 1);
  }
}

TEST_P(SequenceTest, SamplesLostAcrossTheWrapAreCounted) {
  send(turn() - 7, 0);
  const auto d = send(3, 10);
  EXPECT_EQ(d.verdict, SampleVerdict::accepted);
  EXPECT_EQ(d.lost, 9u);
  EXPECT_EQ(d.steps, 10);
}

TEST_P(SequenceTest, AGapThatRestartsCountsAcrossTheWrapToo) {
  send(turn() - 50, 0);
  const auto d = send(150, 200);  // 3 s, 2 s are allowed
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.reason, RestartReason::gap);
  EXPECT_NEAR(d.jump_s, 3.0, 1e-9);
  EXPECT_EQ(d.lost, 199u);
}

TEST_P(SequenceTest, WithoutStampsAWrapIsOneNearTheBoundary) {
  send_stamped(turn() - 1, 0);
  EXPECT_EQ(send_stamped(0, 0).verdict, SampleVerdict::accepted);
  check_.reset();
  send_stamped(turn() - 3, 0);
  EXPECT_EQ(send_stamped(2, 0).lost, 4u);
}

TEST_P(SequenceTest, ASourceThatStartsAnewNearTheBoundaryIsNoWrap) {
  send(turn() - 6, 0);
  const auto d = send(0, 67);  // six samples do not take a second
  EXPECT_EQ(d.verdict, SampleVerdict::restarted);
  EXPECT_EQ(d.reason, RestartReason::source_restarted);
  EXPECT_EQ(d.lost, 0u);
}

TEST_P(SequenceTest, ASourceThatStartsAnewWhenTheTimeNearlyFitsIsNoWrap) {
  for (const double off : {-2.0, -0.5, 0.5, 2.0}) {
    check_.reset();
    send(turn() - 100, 0);
    EXPECT_EQ(send(0, 100 + off).reason, RestartReason::source_restarted) << off;
  }
  check_.reset();
  send(turn() - 100, 0);
  EXPECT_EQ(send(0, 100.1).lost, 99u);  // what is lost may end at the boundary, too
}

TEST_P(SequenceTest, ASourceThatStartsAnewFarFromTheBoundaryIsNoWrap) {
  for (const double time : {2.0, 15.0, 40.0}) {
    check_.reset();
    send(turn() / 2, 0);
    EXPECT_EQ(send(0, time).reason, RestartReason::source_restarted) << time;
    check_.reset();
    send_stamped(turn() / 2, 0);
    EXPECT_EQ(send_stamped(1, 0).verdict, SampleVerdict::restarted) << "without stamps";
  }
}

TEST_P(SequenceTest, SamplesOvertakenAcrossTheWrapAreNoJump) {
  send(turn() - 3, 0);
  EXPECT_EQ(send(1, 4).lost, 3u);
  EXPECT_EQ(send(turn() - 2, 1).verdict, SampleVerdict::reordered);
  EXPECT_EQ(send(turn() - 1, 2).verdict, SampleVerdict::reordered);
  EXPECT_EQ(send(0, 3).verdict, SampleVerdict::reordered);
  EXPECT_EQ(send(2, 5).verdict, SampleVerdict::accepted);
}

INSTANTIATE_TEST_SUITE_P(Bits, SequenceTest, testing::Values(8, 16, 32));

TEST_F(WideSequence, ACounterThatWrappedWrapsWhateverTheClockDoesThen) {
  // A leap second falls on its second wrap.
  for (int k = 0; k < 512; ++k)
    EXPECT_NE(send(static_cast<std::uint64_t>(k % 256), k).verdict, SampleVerdict::restarted) << k;
  EXPECT_EQ(send(0, 512 - 1.0 / sample_time_s).verdict, SampleVerdict::accepted);
}

TEST_F(WideSequence, AGapOfWholeTurnsIsCountedByTheStamps) {
  send(250, 0);
  send(5, 11);  // wraps: eight bits
  const auto d = send((5 + 301) % 256, 312);
  EXPECT_EQ(d.reason, RestartReason::gap);
  EXPECT_EQ(d.lost, 300u);
}

TEST_F(WideSequence, ACounterThatPassesTheBoundaryWasNoNarrowOne) {
  send(250, 0);
  send(0, 6);  // a source that started anew just then: taken for a wrap, and no time is missing
  for (int k = 1; k <= 300; ++k)
    EXPECT_EQ(send(static_cast<std::uint64_t>(k), 6 + k).verdict, SampleVerdict::accepted) << k;
  EXPECT_EQ(send(400, 406).lost, 99u);
  EXPECT_EQ(send(4, 440).reason, RestartReason::source_restarted);
}

TEST_F(WideSequence, AnOvertakenSampleWithALateStampIsStillOvertaken) {
  // NTP set the clock back by 20 ms between the two: the earlier sample has the later stamp.
  send(100, 100.0 - 20.0 / 15.0);
  const auto d = send(99, 99.0);
  EXPECT_EQ(d.verdict, SampleVerdict::reordered);
  EXPECT_EQ(send(101, 101.0 - 20.0 / 15.0).verdict, SampleVerdict::accepted);
}

TEST_F(WideSequence, WithoutStampsARestartShowsInTheNumberAlone) {
  send_stamped(100, 0);
  EXPECT_EQ(send_stamped(97, 0).verdict, SampleVerdict::reordered);
  EXPECT_EQ(send_stamped(60, 0).verdict, SampleVerdict::reordered);  // within two seconds
  EXPECT_EQ(send_stamped(0, 0).reason, RestartReason::source_restarted);
  send_stamped(5000, 0);
  EXPECT_EQ(send_stamped(40, 0).reason, RestartReason::source_restarted);
}

TEST_F(WideSequence, WithoutStampsAGapIsMeasuredByTheSequence) {
  send_stamped(0, 0);
  EXPECT_EQ(send_stamped(20, 0).steps, 20);
  const auto gap = send_stamped(220, 0);
  EXPECT_EQ(gap.reason, RestartReason::gap);
  EXPECT_NEAR(gap.jump_s, 3.0, 1e-9);
  EXPECT_EQ(gap.lost, 199u);
  const auto jump = send_stamped(1'000'000'000'000, 0);
  EXPECT_EQ(jump.reason, RestartReason::sequence_jump);
  EXPECT_EQ(jump.lost, 0u);
}

}  // namespace
