// SPDX-License-Identifier: Apache-2.0
// A source on the wire whose stamps or sequence numbers are not perfect. The cycle's own tests fly longer
// (tests/unit/monitor/cycle/uneven_time_test.cpp); here it is what subscribers hear of it.

#include <gmock/gmock.h>

#include <algorithm>
#include <functional>

#include "tests/integration/pair/engine_samples.h"
#include "tests/integration/pair/pair.h"

namespace {

using namespace ehm;
using namespace ehm::test;
using testing::HasSubstr;

class UnevenSourceTest : public PairTest {
 protected:
  void SetUp() override {
    // Twenty sample times, so that a machine that pauses is no loss of input.
    monitor_ = start_monitor({"--monitor-status-period-s", "0.1", "--checks-stale-periods", "20"});
    ASSERT_TRUE(listener_.await([&] { return writer_.matched() == 2; }));
  }
  /// Sends in real time, each sample spoilt, until the condition holds.
  bool send_until(const std::function<bool()>& condition, const std::function<void(EngineSensors&)>& spoil) {
    return listener_.await([&] {
      for (; std::chrono::steady_clock::now() >= next_; next_ += std::chrono::milliseconds(15)) {
        EngineSensors s = samples_.next();
        spoil(s);
        writer_.write(s);
        ++sent_;
      }
      return condition();
    });
  }
  std::uint64_t processed() const { return listener_.status.empty() ? 0 : listener_.status.back().samples_processed(); }
  std::uint32_t level() const { return listener_.status.back().level(); }
  long raised(idl::EventKind kind) const {
    return std::count_if(listener_.events.begin(), listener_.events.end(), [&](const HealthEvent& e) {
      return e.kind() == static_cast<std::uint32_t>(kind) && e.raised() != 0;
    });
  }

  std::string said(idl::EventKind kind) const {
    const HealthEvent* event = listener_.find_event(kind, true);
    return event ? event->message().c_str() : "";
  }

  std::unique_ptr<Process> monitor_;
  idl::Writer<EngineSensors> writer_{participant_};
  EngineSamples samples_{design_file(), 1};
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
  std::uint64_t sent_ = 0;
};

TEST_F(UnevenSourceTest, StampsThatAreNeverSetAreSaidOnceAndEstimatesGoOn) {
  ASSERT_TRUE(send_until([&] { return processed() > 300; }, [](EngineSensors& s) { s.source_time_ns(0); }));
  EXPECT_EQ(listener_.status.back().filter_restarts(), 0u);
  EXPECT_EQ(listener_.status.back().samples_withheld(), 0u);
  EXPECT_EQ(level(), static_cast<std::uint32_t>(idl::StatusLevel::warn));
  EXPECT_EQ(raised(idl::EventKind::source_stamps), 1);
  EXPECT_EQ(raised(idl::EventKind::filter_restart), 0);
  EXPECT_THAT(said(idl::EventKind::source_stamps), HasSubstr("source_time_ns is not set (0)"));
}

TEST_F(UnevenSourceTest, ASequenceThatStandsStillIsNamedAndIsNoLossOfInput) {
  ASSERT_TRUE(send_until([&] { return processed() > 100; }, [](EngineSensors&) {}));
  const std::uint64_t stands_at = sent_;
  ASSERT_TRUE(send_until([&] { return listener_.status.back().samples_duplicated() > 60; },
                         [&](EngineSensors& s) { s.sequence_number(stands_at); }));
  EXPECT_EQ(level(), static_cast<std::uint32_t>(idl::StatusLevel::error));
  EXPECT_EQ(raised(idl::EventKind::source_sequence), 1);
  EXPECT_EQ(raised(idl::EventKind::input_lost), 0);
  EXPECT_THAT(said(idl::EventKind::source_sequence), HasSubstr("sequence stands still"));
  // The source falls silent: now the input is lost.
  ASSERT_TRUE(listener_.await([&] { return raised(idl::EventKind::input_lost) == 1; }));
  EXPECT_THAT(said(idl::EventKind::input_lost), HasSubstr("no sample for 0."));
}

}  // namespace
