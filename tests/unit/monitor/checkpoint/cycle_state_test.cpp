// SPDX-License-Identifier: Apache-2.0
// A cycle that resumes goes on as if it had never stopped; after a gap it is where it was within its sigma.

#include "monitor/cycle/cycle_state.h"

#include <gtest/gtest.h>

#include <limits>

#include "idl/wire_values.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
namespace flag = ehm::idl::estimate_flag;

constexpr int settled = 3000;  // samples: far beyond the design's settling time
constexpr double max_gap_s = 60.0;

class CycleStateTest : public testing::Test {
 protected:
  CycleStateTest() {
    test::Random random(7);
    flight_.emplace(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)), 11);
  }
  Sample fly(int samples, bool sensor_2_lost = false) {
    Sample s;
    for (int i = 0; i < samples; ++i) {
      s = flight_->next();
      if (sensor_2_lost) s.sensor[2] = std::numeric_limits<double>::quiet_NaN();
      first_.process(s);
    }
    return s;
  }
  CycleState snapshot() {
    CycleState state;
    EXPECT_TRUE(first_.snapshot(state));
    return state;
  }
  void expect_successor_within_one_sigma() {
    for (Eigen::Index i = 0; i < 10; ++i)
      EXPECT_LT(std::abs(second_.watch().filter().health()(i) - first_.watch().filter().health()(i)),
                first_.watch().error().health_sigma()(i))
          << i;
  }

  std::shared_ptr<const design::Design> design_ = test::made_up_design();
  std::optional<test::Flight> flight_;
  MonitorCycle first_{design_, CycleOptions{}}, second_{design_, CycleOptions{}};
};

TEST_F(CycleStateTest, TheNextSampleGivesTheSameBits) {
  for (const int flown : {20, settled}) {  // converging, and settled
    MonitorCycle successor(design_, CycleOptions{});
    fly(flown);
    const CycleState state = snapshot();
    for (int k = 0; k < 3; ++k) {
      const Sample next = flight_->next();
      if (k == 0) {
        ASSERT_EQ(successor.resume(state, next, max_gap_s), Resumption::taken);
      }
      first_.process(next);
      successor.process(next);
      EXPECT_EQ(successor.watch().filter().health(), first_.watch().filter().health());
      EXPECT_EQ(successor.watch().filter().auxiliary(), first_.watch().filter().auxiliary());
      EXPECT_EQ(successor.watch().error().health_sigma(), first_.watch().error().health_sigma());
      EXPECT_EQ(successor.result().flags, first_.result().flags);
    }
  }
}

TEST_F(CycleStateTest, AfterAGapItIsWhereItWas) {
  fly(settled);
  const CycleState state = snapshot();
  flight_->set_actuator(0.5);  // the engine moves while nobody looks
  const Sample next = fly(300);
  ASSERT_EQ(second_.resume(state, next, max_gap_s), Resumption::taken);
  second_.process(next);
  EXPECT_FALSE(second_.result().flags & flag::converging);
  EXPECT_EQ(second_.counters().lost, 0u);  // what passed before it was there is not its loss
  EXPECT_EQ(second_.counters().restarts, 0u);
  expect_successor_within_one_sigma();
}

TEST_F(CycleStateTest, AColdStartIsNotThere) {  // the negative of the test above: it can fail
  fly(settled);
  const Sample next = fly(300);
  second_.process(next);
  EXPECT_TRUE(second_.result().flags & flag::converging);
  double worst = 0.0;
  for (Eigen::Index i = 0; i < 10; ++i)
    worst = std::max(worst, std::abs(second_.watch().filter().health()(i) - first_.watch().filter().health()(i)) /
                                first_.watch().error().health_sigma()(i));
  EXPECT_GT(worst, 1.0);
}

TEST_F(CycleStateTest, ConvergingGoesOnConverging) {
  fly(50);
  const CycleState state = snapshot();
  const Sample next = fly(10);
  ASSERT_EQ(second_.resume(state, next, max_gap_s), Resumption::taken);
  second_.process(next);
  EXPECT_TRUE(second_.result().flags & flag::converging);
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_GT(second_.watch().error().health_sigma()(i), 0.999 * first_.watch().error().health_sigma()(i))
        << i;  // never more certain
}

TEST_F(CycleStateTest, AFaultySensorStaysOut) {
  fly(settled);
  fly(50, true);
  const CycleState state = snapshot();
  EXPECT_EQ(state.watch.missing_sensor, 2);
  const Sample next = fly(1, true);
  ASSERT_EQ(second_.resume(state, next, max_gap_s), Resumption::taken);
  second_.process(next);
  EXPECT_EQ(second_.watch().filter().sensor_set().missing(), 2);
  EXPECT_TRUE(second_.result().flags & flag::degraded);
  ASSERT_EQ(second_.events().size(), 1u);
  EXPECT_EQ(second_.events().begin()->kind, idl::EventKind::sensor_fault);
  EXPECT_EQ(second_.events().begin()->channel, 2u);
  expect_successor_within_one_sigma();
}

TEST_F(CycleStateTest, OnlyASampleThatContinuesTheStreamResumes) {
  fly(settled);
  const CycleState state = snapshot();
  const Sample next = flight_->next();
  Sample other = next;
  other.source_id = 9;
  EXPECT_EQ(second_.resume(state, other, max_gap_s), Resumption::other_source);
  Sample same = next;
  same.sequence = state.sequence;
  EXPECT_EQ(second_.resume(state, same, max_gap_s), Resumption::not_later);
  Sample back = next;
  back.source_time_ns = state.source_time_ns - 1;
  EXPECT_EQ(second_.resume(state, back, max_gap_s), Resumption::not_later);
  Sample late = next;
  late.source_time_ns = state.source_time_ns + 60'000'000'001;
  EXPECT_EQ(second_.resume(state, late, max_gap_s), Resumption::too_old);
  Sample extreme = next;
  extreme.source_time_ns = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(second_.resume(state, extreme, max_gap_s), Resumption::not_later);
  EXPECT_EQ(second_.watch().filter().health(),
            MonitorCycle(design_, CycleOptions{}).watch().filter().health());  // untouched
}

TEST_F(CycleStateTest, WithoutStampsTheSequenceTellsTheGap) {
  fly(settled);
  CycleState state = snapshot();
  state.source_time_ns = 0;
  Sample next = flight_->next();
  next.source_time_ns = 0;
  next.sequence = state.sequence + 200;
  const double sample_time_s = design_->model.sample_time_s;
  const Continuation c = continuation(state, next, sample_time_s, max_gap_s);
  EXPECT_EQ(c.verdict, Resumption::taken);
  EXPECT_NEAR(c.gap_s, 3.0, 1e-9);  // 200 times 15 ms
  EXPECT_EQ(c.ahead, 200u);
  next.sequence = state.sequence + 4001;  // 60 s are allowed
  EXPECT_EQ(continuation(state, next, sample_time_s, max_gap_s).verdict, Resumption::too_old);
  next.sequence = 0;
  EXPECT_EQ(continuation(state, next, sample_time_s, max_gap_s).verdict, Resumption::not_later);
}

TEST_F(CycleStateTest, ACounterThatWrappedInBetweenContinuesTheStream) {
  fly(settled);
  CycleState state = snapshot();
  state.sequence = 65530;
  Sample next = flight_->next();
  next.sequence = 94;  // 100 samples later
  next.source_time_ns = state.source_time_ns + 1'500'000'000;
  const Continuation c = continuation(state, next, design_->model.sample_time_s, max_gap_s);
  EXPECT_EQ(c.verdict, Resumption::taken);
  EXPECT_EQ(c.ahead, 100u);
  EXPECT_EQ(second_.resume(state, next, max_gap_s), Resumption::taken);
}

TEST_F(CycleStateTest, AStateOfAnotherShapeIsRefused) {
  fly(settled);
  const Sample next = flight_->next();
  CycleState state = snapshot();
  state.watch.estimate.conservativeResize(state.watch.estimate.size() - 1);
  EXPECT_EQ(second_.resume(state, next, max_gap_s), Resumption::wrong_shape);
  state = snapshot();
  state.watch.error.mean.conservativeResize(state.watch.error.mean.rows(), 1);
  EXPECT_EQ(second_.resume(state, next, max_gap_s), Resumption::wrong_shape);
  state = snapshot();
  state.watch.missing_sensor = 15;
  EXPECT_EQ(second_.resume(state, next, max_gap_s), Resumption::wrong_shape);
}

TEST_F(CycleStateTest, EstimatorsBesideGoOnWithTheSameBitsToo) {
  CycleOptions options;
  options.estimator.published = "time_varying";
  options.estimator.shadow = "gauss_markov";
  for (const int flown : {20, settled}) {
    MonitorCycle first(design_, options), successor(design_, options);
    for (int i = 0; i < flown; ++i) first.process(flight_->next());
    CycleState state;
    ASSERT_TRUE(first.snapshot(state));
    for (int k = 0; k < 3; ++k) {
      const Sample next = flight_->next();
      if (k == 0) {
        ASSERT_EQ(successor.resume(state, next, max_gap_s), Resumption::taken);
      }
      first.process(next);
      successor.process(next);
      EXPECT_EQ(successor.result().estimate.health, first.result().estimate.health);
      EXPECT_EQ(successor.result().estimate.health_sigma, first.result().estimate.health_sigma);
      ASSERT_EQ(successor.result().shadow.size(), 1u);
      EXPECT_EQ(successor.result().shadow[0].health, first.result().shadow[0].health);
      EXPECT_EQ(successor.result().shadow[0].health_sigma, first.result().shadow[0].health_sigma);
    }
  }
}

TEST_F(CycleStateTest, WithoutTheirStateEstimatorsBesideStartColdAndTheWatchFilterGoesOn) {
  CycleOptions options;
  options.estimator.shadow = "time_varying,gauss_markov";
  MonitorCycle first(design_, options);
  for (int i = 0; i < settled; ++i) first.process(flight_->next());
  CycleState state;
  ASSERT_TRUE(first.snapshot(state));
  const Sample next = flight_->next();
  first.process(next);
  const CycleState whole = state;
  const auto resumed = [&] {
    auto successor = std::make_unique<MonitorCycle>(design_, options);
    EXPECT_EQ(successor->resume(state, next, max_gap_s), Resumption::companions_cold);
    successor->process(next);
    EXPECT_EQ(successor->watch().filter().health(), first.watch().filter().health());
    return successor;
  };
  state.companions.clear();  // a checkpoint of an earlier version
  EXPECT_FALSE(resumed()->result().shadow[0].settled);
  EXPECT_GT(resumed()->result().shadow[0].health_sigma.norm(), 1.05 * first.result().shadow[0].health_sigma.norm());
  EXPECT_FALSE(resumed()->result().shadow[1].settled);
  state = whole;
  state.companions[0].state.estimate.conservativeResize(3);  // of another shape: only this one
  EXPECT_FALSE(resumed()->result().shadow[0].settled);
  EXPECT_EQ(resumed()->result().shadow[1].health, first.result().shadow[1].health);
}

TEST_F(CycleStateTest, NothingToKeepWithoutAnEstimate) {
  CycleState state;
  EXPECT_FALSE(first_.snapshot(state));
  Sample s = flight_->next();
  s.actuator[0] *= 2.0;  // off the design
  first_.process(s);
  EXPECT_FALSE(first_.snapshot(state));
}

}  // namespace
