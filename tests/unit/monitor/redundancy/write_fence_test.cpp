// SPDX-License-Identifier: Apache-2.0
// When a monitor with a partner may write, in time that the test makes up.

#include "monitor/redundancy/write_fence.h"

#include <gtest/gtest.h>

namespace {

using ehm::monitor::WriteFence;

constexpr std::int64_t ms = 1'000'000;
constexpr std::int64_t period = 15 * ms;

class WriteFenceTest : public testing::Test {
 protected:
  WriteFenceTest() {
    // Past the quiet start, and in the rhythm of the samples.
    for (int i = 0; i < 50; ++i) sample();
    heard_ = true;
  }
  /// The next sample comes on time.
  bool sample() { return writes_at(now_ + period); }
  bool writes_at(std::int64_t at) {
    now_ = at;
    return fence_.may_write(now_);
  }
  /// No input: the cycle goes on waking up every 15 ms.
  void silence(std::int64_t length) {
    for (const std::int64_t end = now_ + length; now_ < end;) fence_.awake(now_ += period);
  }
  /// First moment, counted from now, at which a sample is written.
  std::int64_t quiet_for() {
    const std::int64_t from = now_;
    while (!sample()) EXPECT_LT(now_ - from, 10'000 * ms);
    return now_ - from;
  }

  std::atomic<bool> heard_{false};
  std::int64_t now_ = 1'000'000 * ms;
  WriteFence fence_{now_, heard_};
};

TEST_F(WriteFenceTest, IsQuietAtFirst) {
  WriteFence fence(0, heard_);
  for (std::int64_t t = 0; t < WriteFence::quiet_ns; t += period) EXPECT_FALSE(fence.may_write(t));
  EXPECT_TRUE(fence.may_write(WriteFence::quiet_ns + period));
}

TEST_F(WriteFenceTest, WritesWhileSamplesCome) {
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(sample());
  EXPECT_TRUE(heard_);
}

TEST_F(WriteFenceTest, WhoWasHeardAndHeldUpYieldsAtOnceAndIsQuiet) {
  // Within a turn: the samples of the pause follow each other without a wait.
  EXPECT_FALSE(writes_at(now_ + 70 * ms));
  EXPECT_FALSE(heard_);
  for (int i = 0; i < 5; ++i) EXPECT_FALSE(writes_at(now_ + ms / 10));
  EXPECT_GT(quiet_for(), WriteFence::quiet_ns - 2 * period);
}

TEST_F(WriteFenceTest, APauseWhileWaitingForInputIsAPauseToo) {
  fence_.awake(now_ += period);
  fence_.awake(now_ += 50 * ms);
  EXPECT_FALSE(writes_at(now_));
  EXPECT_FALSE(heard_);
}

TEST_F(WriteFenceTest, AShortPauseIsNone) {
  EXPECT_TRUE(writes_at(now_ + WriteFence::longest_silence_ns));
  EXPECT_TRUE(heard_);
}

TEST_F(WriteFenceTest, WhoWasHeardSpeaksFirstAfterASilence) {
  silence(1000 * ms);
  EXPECT_TRUE(sample());
  EXPECT_TRUE(heard_);
}

TEST_F(WriteFenceTest, WhoStandsByLetsTheOtherSpeakFirstAfterASilence) {
  heard_ = false;
  silence(1000 * ms);
  EXPECT_FALSE(sample());
  EXPECT_LE(quiet_for(), WriteFence::lease_ns + period);
  EXPECT_TRUE(sample());
}

TEST_F(WriteFenceTest, WhoStandsByAndWasHeldUpIsBackAfterTheLease) {
  heard_ = false;
  EXPECT_FALSE(writes_at(now_ + 300 * ms));
  EXPECT_LE(quiet_for(), WriteFence::lease_ns + period);
}

TEST_F(WriteFenceTest, SamplesFarApartDoNotSilenceTheStandbyForGood) {
  heard_ = false;
  int written = 0;
  for (int i = 0; i < 20; ++i) {
    silence(90 * ms);
    written += writes_at(now_ + 10 * ms);
  }
  EXPECT_GE(written, 10);
}

}  // namespace
