// SPDX-License-Identifier: Apache-2.0
// The estimators beside the watch filter: chosen in flight, at rest after an overrun, and what is told of them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "idl/wire_names.h"
#include "monitor/cycle/monitor_cycle.h"
#include "monitor/shared/budget_watch.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tests/unit/monitor/cycle/moody.h"

namespace {

using namespace ehm;
using idl::EventKind;
using monitor::MonitorCycle;
using monitor::Publishing;

/// `ekf` is published, `ukf` and the tuner filter are shadows; their health is 0.5 and 0.25 of everything.
class Companions : public ::testing::Test {
 protected:
  Companions() {
    monitor::PreparedDesign prepared(test::made_up_design());
    prepared.companions.push_back({"ekf", std::make_shared<const test::Moody>(ekf_)});
    prepared.companions.push_back({"ukf", std::make_shared<const test::Moody>(ukf_, 0.25)});
    prepared.published = 0;
    prepared.shadows = {1, monitor::watch_filter};
    cycle_ = std::make_unique<MonitorCycle>(prepared, monitor::CycleOptions{});
  }
  void fly(int samples) {
    for (int k = 0; k < samples; ++k) {
      cycle_->clear_events();
      cycle_->process(flight_.next());
      for (const auto& event : cycle_->events()) heard_.push(event);
    }
  }
  int heard(EventKind kind, bool raised) const {
    return static_cast<int>(std::count_if(heard_.begin(), heard_.end(),
                                          [&](const auto& e) { return e.kind == kind && e.raised == raised; }));
  }
  const estimation::Estimate& published() const { return cycle_->result().estimate; }

  std::shared_ptr<bool> ekf_ = std::make_shared<bool>(true), ukf_ = std::make_shared<bool>(true);
  test::Flight flight_{test::made_up_design()->model, Eigen::VectorXd::Zero(10), 3};
  std::unique_ptr<MonitorCycle> cycle_;
  monitor::EventList heard_;
};

TEST_F(Companions, AnotherIsPublishedFromTheNextSampleOnAndTheFirstFliesOn) {
  fly(50);
  ASSERT_EQ(published().health(0), 0.5);
  ASSERT_EQ(cycle_->publish("ukf"), Publishing::done);
  EXPECT_EQ(cycle_->published(), "ukf");
  ASSERT_EQ(cycle_->events().size(), 1u);
  EXPECT_EQ(cycle_->events().begin()->kind, EventKind::estimator_chosen);
  EXPECT_EQ(idl::estimator_names[cycle_->events().begin()->channel], std::string("ukf"));
  fly(1);
  EXPECT_TRUE(cycle_->result().estimates);
  EXPECT_EQ(published().health(0), 0.25);
  EXPECT_EQ(cycle_->result().shadow[0].health(0), 0.25);  // its own topic goes on
  EXPECT_EQ(cycle_->publish("ukf"), Publishing::already);
  EXPECT_EQ(cycle_->publish("ekf"), Publishing::done);
  fly(1);
  EXPECT_EQ(published().health(0), 0.5);
}

TEST_F(Companions, TheTunerFilterGoesOnAsItIsWhenItIsPublished) {
  fly(1200);  // more than seven of its time constants
  const auto before = cycle_->watch().estimate();
  ASSERT_EQ(cycle_->publish("tuner"), Publishing::done);
  fly(1);
  EXPECT_EQ(published().health, cycle_->watch().estimate().health);
  EXPECT_LT((published().health - before.health).cwiseAbs().maxCoeff(), 0.1 * before.health_sigma.maxCoeff());
  EXPECT_FALSE(cycle_->result().flags & idl::estimate_flag::converging);  // not a new start
  EXPECT_EQ(cycle_->counters().restarts, 0u);
}

TEST_F(Companions, WhoCannotBePublishedIsRefusedAndNothingChanges) {
  EXPECT_EQ(cycle_->publish("ukf"), Publishing::no_answer);  // no sample yet
  fly(5);
  EXPECT_EQ(cycle_->publish("onboard"), Publishing::not_flying);
  EXPECT_EQ(cycle_->publish(""), Publishing::not_flying);
  *ukf_ = false;
  fly(1);
  EXPECT_EQ(cycle_->publish("ukf"), Publishing::no_answer);
  EXPECT_EQ(cycle_->published(), "ekf");
  EXPECT_EQ(published().health(0), 0.5);
  EXPECT_TRUE(cycle_->no_input(1.0));
  EXPECT_EQ(cycle_->publish("tuner"), Publishing::no_answer);  // what it knows is of long ago
}

TEST_F(Companions, AShadowWithoutAnAnswerHasNoEstimate) {
  fly(5);
  EXPECT_TRUE(cycle_->result().shadow[0].holds);
  *ukf_ = false;
  fly(1);
  EXPECT_FALSE(cycle_->result().shadow[0].holds);
  EXPECT_TRUE(cycle_->result().shadow[1].holds);
}

TEST_F(Companions, WhoRestsHasNoEstimateForTenSecondsAndTheTunerFilterTakesItsPlace) {
  fly(400);
  cycle_->rest(0, 9000.0, 7500.0);
  EXPECT_EQ(cycle_->events().raised_total(), heard_.raised_total() + 1);
  const int rest = static_cast<int>(std::lround(10.0 / cycle_->design().model.sample_time_s));
  fly(2);
  EXPECT_FALSE(cycle_->result().estimates);
  fly(1);
  EXPECT_TRUE(cycle_->result().estimates);
  EXPECT_TRUE(cycle_->result().flags & idl::estimate_flag::fallback);
  EXPECT_EQ(published().health, cycle_->watch().estimate().health);
  fly(rest - 4);
  EXPECT_EQ(heard(EventKind::estimator_overrun, false), 0);
  fly(1);
  EXPECT_EQ(heard(EventKind::estimator_overrun, false), 1);
  fly(200);  // as long as a fallback takes to trust it again
  EXPECT_EQ(published().health(0), 0.5);
  EXPECT_FALSE(cycle_->result().flags & idl::estimate_flag::fallback);
}

TEST_F(Companions, TalliesTellTimeInnovationsAndDifference) {
  static std::int64_t clock_ns;
  clock_ns = 0;
  cycle_->measure([]() noexcept -> std::int64_t { return clock_ns += 1000; });  // each look at it takes 1 us
  fly(100);
  std::vector<monitor::EstimatorTally> tallies;
  cycle_->for_each_tally([&](const auto& tally) { tallies.push_back(tally); });
  ASSERT_EQ(tallies.size(), 3u);
  EXPECT_EQ(tallies[0].name, "tuner");
  EXPECT_EQ(tallies[1].name, "ekf");
  EXPECT_EQ(tallies[1].samples, 100u);
  EXPECT_EQ(tallies[1].answers, 100u);
  EXPECT_EQ(tallies[1].spent_ns, 300'000);  // predict, innovate and update, 1 us each
  EXPECT_EQ(tallies[1].longest_ns, 3000);
  EXPECT_EQ(cycle_->companions().lap_ns(0), 3000);
  EXPECT_EQ(tallies[1].difference, 0.0);  // published itself
  EXPECT_DOUBLE_EQ(tallies[2].difference, (0.5 - 0.25) / 0.5);
  EXPECT_EQ(tallies[2].innovation_ratio, 0.0);  // Moody's innovations are 0
  EXPECT_GT(tallies[0].innovation_ratio, 0.0);
}

TEST(EstimatorTally, InnovationRatioIsTheMeanSquareOverVarianceOfFusedSensors) {
  monitor::EstimatorTally tally("ekf");
  estimation::Innovation innovation{estimation::SensorVector::Constant(3, 2.0),
                                    estimation::SensorVector::Constant(3, 1.0)};
  innovation.value(2) = std::numeric_limits<double>::quiet_NaN();  // no value, not fused
  tally.look(innovation, estimation::SensorMask(0b011));
  EXPECT_DOUBLE_EQ(tally.innovation_ratio, 4.0);
  innovation.value.setZero();
  tally.look(innovation, estimation::SensorMask(0b011));
  EXPECT_DOUBLE_EQ(tally.innovation_ratio, 2.0);  // of two samples
  tally.look(innovation, estimation::SensorMask());
  EXPECT_DOUBLE_EQ(tally.innovation_ratio, 2.0);  // nothing was fused, nothing is learned
}

TEST(BudgetWatch, ThreeOverrunsInARowAndNotOnePause) {
  monitor::BudgetWatch watch;
  for (int k = 0; k < 10; ++k) {
    EXPECT_FALSE(watch.look(0, 9'000'000, 7.5));
    EXPECT_FALSE(watch.look(0, 9'000'000, 7.5));
    EXPECT_FALSE(watch.look(0, 1'000'000, 7.5));
    EXPECT_FALSE(watch.look(1, 9'000'000, 0.0));  // no limit
  }
  EXPECT_FALSE(watch.look(0, 7'500'001, 7.5));
  EXPECT_FALSE(watch.look(0, 7'500'001, 7.5));
  EXPECT_TRUE(watch.look(0, 7'500'001, 7.5));
}

TEST(EstimatorNumber, EveryEstimatorOfTheTableHasOneOnTheWire) {
  for (const design::EstimatorKind& kind : design::estimator_kinds()) {
    const int number = idl::estimator_number(kind.name);
    ASSERT_GE(number, 0) << kind.name;
    const auto order =
        static_cast<std::uint32_t>(idl::MonitorCommandKind::publish) + static_cast<std::uint32_t>(number);
    EXPECT_EQ(idl::ordered_estimator(order), kind.name);
  }
  EXPECT_EQ(idl::estimator_number("kalman"), -1);
  EXPECT_EQ(idl::ordered_estimator(1), "");    // a reset
  EXPECT_EQ(idl::ordered_estimator(511), "");  // no such number
}

}  // namespace
