// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/condition_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "monitor/checks/actuator_reach.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double lasts = 5;  // checks.bridge_samples

linear_model::LinearModel cruise() {
  linear_model::LinearModel model;
  model.sample_time_s = 0.015;
  model.operating_point = {10668.0, 0.8, 0.0};
  model.controls = {{"fuel_flow", "kg/s", 1.0}, {"VSV", "deg", 0.0}};
  return model;
}

class ConditionCheckTest : public testing::Test {
 protected:
  static Sample good() {
    Sample s;
    s.flight = {10668.0, 0.8, 0.0};
    s.actuator = {1.0, 0.5};
    return s;
  }
  /// Offers the sample; returns it mended.
  Sample offer(Sample s, int steps = 1) {
    usable_ = check_.mend(s, steps, events_);
    return s;
  }
  void fly(int samples) {
    for (int i = 0; i < samples; ++i) offer(good());
  }
  const Event& last() const { return *(events_.end() - 1); }

  ConditionCheck check_{CheckOptions{}, cruise()};
  EventList events_;
  bool usable_ = false;
};

TEST_F(ConditionCheckTest, OneBadWordIsReplacedByTheLastGoodOne) {
  fly(10);
  const auto spoilt = [](auto spoil) {
    Sample s = good();
    spoil(s);
    return s;
  };
  for (const Sample& bad :
       {spoilt([](Sample& s) { s.flight.altitude_m = 0.0; }), spoilt([](Sample& s) { s.flight.mach = 0.0; }),
        spoilt([](Sample& s) { s.flight.delta_isa_k = nan; }), spoilt([](Sample& s) { s.actuator[0] = 0.0; }),
        spoilt([](Sample& s) { s.actuator[0] = -std::numeric_limits<double>::infinity(); }),
        spoilt([](Sample& s) { s.actuator[1] = 40.0; })}) {
    const Sample mended = offer(bad);
    EXPECT_TRUE(usable_);
    EXPECT_EQ(check_.replaced(), 1u);
    EXPECT_EQ(mended.flight.altitude_m, 10668.0);
    EXPECT_EQ(mended.flight.mach, 0.8);
    EXPECT_EQ(mended.flight.delta_isa_k, 0.0);
    EXPECT_EQ(mended.actuator[0], 1.0);
    EXPECT_EQ(mended.actuator[1], 0.5);
  }
  offer(good());
  EXPECT_EQ(check_.replaced(), 0u);
  EXPECT_EQ(events_.size(), 0u);
}

TEST_F(ConditionCheckTest, AMoveThatAnAircraftCanMakePasses) {
  fly(10);
  Sample s = good();
  for (int i = 0; i < 1000; ++i) {  // 50 m/s down; fuel cut within two seconds
    s.flight.altitude_m -= 0.75;
    s.actuator[0] = std::max(0.2, s.actuator[0] - 0.0075);
    const Sample mended = offer(s);
    ASSERT_EQ(mended.flight.altitude_m, s.flight.altitude_m);
    ASSERT_EQ(mended.actuator[0], s.actuator[0]);
  }
  EXPECT_EQ(events_.size(), 0u);
}

TEST_F(ConditionCheckTest, AMoveThatLastsIsBelievedAndSaid) {
  fly(10);
  Sample s = good();
  s.flight.altitude_m = 3000.0;
  for (int i = 0; i < lasts; ++i) EXPECT_EQ(offer(s).flight.altitude_m, 10668.0);
  EXPECT_EQ(events_.size(), 0u);
  EXPECT_EQ(offer(s).flight.altitude_m, 3000.0);
  EXPECT_TRUE(usable_);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(last().kind, idl::EventKind::condition_fault);
  EXPECT_EQ(last().channel, 0u);
  EXPECT_EQ(last().value, 3000.0);
  EXPECT_EQ(last().threshold, 10668.0);
  EXPECT_EQ(offer(good()).flight.altitude_m, 10668.0) << "back at once";
  fly(200);
  ASSERT_EQ(events_.size(), 2u);
  EXPECT_FALSE(last().raised);
}

TEST_F(ConditionCheckTest, AWordThatIsLostMakesTheSampleUselessUntilItReturns) {
  fly(10);
  Sample s = good();
  s.actuator[0] = nan;
  for (int i = 0; i < lasts; ++i) {
    EXPECT_EQ(offer(s).actuator[0], 1.0);
    EXPECT_TRUE(usable_);
  }
  EXPECT_EQ(offer(s).actuator[0], 1.0);
  EXPECT_FALSE(usable_);
  ASSERT_EQ(events_.size(), 1u);
  EXPECT_EQ(last().channel, flight_words + 0u);
  EXPECT_EQ(last().detail, 1u);
  offer(good());
  EXPECT_TRUE(usable_);
}

TEST_F(ConditionCheckTest, WordsThatAgreeWithNothingAreLost) {
  fly(10);
  Sample s = good();
  for (int i = 0; i < 6; ++i) {
    s.flight.mach = i % 2 == 0 ? 0.0 : 5.0;
    offer(s);
  }
  EXPECT_FALSE(usable_);
}

TEST_F(ConditionCheckTest, WithoutAGoodWordYetTheTrimStandsInAndNothingIsEstimated) {
  Sample s = good();
  s.actuator[0] = nan;
  EXPECT_EQ(offer(s).actuator[0], 1.0);
  EXPECT_FALSE(usable_);
}

TEST_F(ConditionCheckTest, ABadFirstWordIsNoPlaceToReturnTo) {
  Sample zero = good();
  zero.flight.altitude_m = 0.0;
  offer(zero);
  fly(6);
  EXPECT_EQ(offer(good()).flight.altitude_m, 10668.0);
  EXPECT_EQ(offer(zero).flight.altitude_m, 10668.0);
}

TEST_F(ConditionCheckTest, AfterALossOfSamplesMoreIsPlausible) {
  fly(10);
  Sample s = good();
  s.flight.altitude_m += 250.0;  // 100 m + 150 m/s * 1.5 s
  EXPECT_EQ(offer(s, 100).flight.altitude_m, s.flight.altitude_m);
}

/// One state, one sensor, a bleed that is closed at trim:  g = D + C B/(1 - A) = -1 + 2 (-1)/0.5 = -5 K per kg/s.
linear_model::LinearModel with_bleed() {
  linear_model::LinearModel model = cruise();
  model.sensors = {{"T48", "K", 1000.0}};
  model.controls.push_back({"customer_bleed", "kg/s", 0.0});
  model.A = Eigen::MatrixXd::Constant(1, 1, 0.5);
  model.B = Eigen::MatrixXd{{0.0, 0.0, -1.0}};
  model.C = Eigen::MatrixXd::Constant(1, 1, 2.0);
  model.D = Eigen::MatrixXd{{0.0, 0.0, -1.0}};
  return model;
}

TEST_F(ConditionCheckTest, AnActuatorWithoutATrimIsMeasuredByWhatItDoes) {
  EXPECT_NEAR(actuator_reach(with_bleed())(2), 200.0, 1e-9);
  EXPECT_TRUE(std::isinf(actuator_reach(with_bleed())(0)));  // moves nothing
  check_ = ConditionCheck{CheckOptions{}, with_bleed()};
  Sample s = good();
  s.actuator[2] = 2.0;
  for (int k = 0; k < 10; ++k) EXPECT_EQ(offer(s).actuator[2], 2.0);
  s.actuator[2] = 15.0;  // a tenth of the reach is 20
  EXPECT_EQ(offer(s).actuator[2], 15.0);
  s.actuator[2] = 80.0;
  EXPECT_EQ(offer(s).actuator[2], 15.0);
  EXPECT_TRUE(usable_);
}

TEST_F(ConditionCheckTest, AWordThatNoEngineSurvivesIsNotBelievedEvenAsTheFirst) {
  check_ = ConditionCheck{CheckOptions{}, with_bleed()};
  for (const std::size_t actuator : {0u, 2u}) {
    check_.reset(events_);
    Sample s = good();
    s.actuator[actuator] = 5.6e89;  // found by the fuzzer: estimates of 1e83 with a sigma that was no number
    for (int k = 0; k < 3 * static_cast<int>(lasts); ++k) {
      EXPECT_EQ(offer(s).actuator[actuator], actuator == 0 ? 1.0 : 0.0);
      EXPECT_FALSE(usable_);
    }
  }
}

}  // namespace
