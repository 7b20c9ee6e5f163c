// SPDX-License-Identifier: Apache-2.0
#include "monitor/checks/sensor_check.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <stdexcept>

#include "idl/wire_values.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;
namespace reason = ehm::idl::reject_reason;

/// Health of a fleet with a sigma of 2 % moves the sensor by 20 (a sigma).
linear_model::LinearModel one_sensor(double trim, const char* unit = "K") {
  linear_model::LinearModel model;
  model.sensors = {{"T30", unit, trim}};
  model.sensor_noise_sigma = Eigen::VectorXd::Constant(1, 5.0);
  model.health_sigma = Eigen::VectorXd::Constant(1, 0.02);
  model.A = Eigen::MatrixXd::Constant(1, 1, 0.5);
  model.L = model.C = Eigen::MatrixXd::Zero(1, 1);
  model.M = Eigen::MatrixXd::Constant(1, 1, 1000.0);
  model.F.resize(0, 1);
  model.N.resize(0, 1);
  return model;
}

/// The largest deviation from trim that is in range, to half a unit.
double range_of(const linear_model::LinearModel& model) {
  SensorCheck check{CheckOptions{}, {}, model};
  double far = 0.0;
  for (double each = 1.0; each < 2000.0; each += 0.5) {
    check.reset();
    Sample s;
    s.sensor_valid = 1u;
    s.sensor[0] = model.sensors[0].trim + each;
    if (check.reasons(s, 0, 1) == 0) far = each;
  }
  return far;
}

TEST(SensorCheck, RangesDoNotDependOnTheZeroOfTheUnit) {
  // 60 % of 1000 K; of 726.85 degC, which is the same; of 1340.33 degF in steps of 5/9 K
  EXPECT_NEAR(range_of(one_sensor(1000.0)), 600.0, 0.5);
  EXPECT_NEAR(range_of(one_sensor(726.85, "degC")), 600.0, 0.5);
  EXPECT_NEAR(range_of(one_sensor(1340.33, "degF")), 1080.0, 0.5);
  // 4 degC: 60 % of 277.15 K is less than 60 noise sigmas of 5
  EXPECT_NEAR(range_of(one_sensor(4.0, "degC")), 300.0, 0.5);
  // A gauge pressure, and a trim near zero: noise and spread count, 5 against 20 / 10
  EXPECT_NEAR(range_of(one_sensor(1000.0, "psig")), 300.0, 0.5);
  EXPECT_NEAR(range_of(one_sensor(0.01, "kPa")), 300.0, 0.5);
  linear_model::LinearModel quiet = one_sensor(0.01, "kPa");
  quiet.sensor_noise_sigma(0) = 1e-3;
  EXPECT_NEAR(range_of(quiet), 120.0, 0.5) << "six sigmas of the fleet";
}

class SensorCheckTest : public testing::Test {
 protected:
  std::uint32_t offer(double value, bool valid = true, int steps = 1) {
    Sample s;
    s.sensor_valid = valid ? 1u : 0u;
    s.sensor[0] = value;
    return check_.reasons(s, 0, steps);
  }
  // Defaults: range 60 % of trim, rate 12 % a sample; fewer than 20 equal values are never stuck.
  SensorCheck check_{CheckOptions{}, {}, one_sensor(1000.0)};
};

TEST_F(SensorCheckTest, PassesAPlausibleValue) {
  EXPECT_EQ(offer(1005.0), 0u);
}

TEST_F(SensorCheckTest, NamesTheReason) {
  EXPECT_EQ(offer(1000.0, false), reason::source_invalid);
  EXPECT_EQ(offer(std::numeric_limits<double>::quiet_NaN()), reason::not_finite);
  EXPECT_EQ(offer(-std::numeric_limits<double>::infinity()), reason::not_finite);
  EXPECT_EQ(offer(1601.0), reason::range);
}

TEST_F(SensorCheckTest, RateCountsTheTimeSinceTheLastValue) {
  EXPECT_EQ(offer(1000.0), 0u);
  EXPECT_EQ(offer(1121.0), reason::rate);
  EXPECT_EQ(offer(1000.0, true, 2), 0u);  // 121 K back within two samples
}

TEST_F(SensorCheckTest, ANoisySensorIsStuckAfterTwentyEqualValuesAndFreeWithTheNextOther) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) offer(1000.0 + 5.0 * normal(random));
  for (int i = 0; i < 19; ++i) EXPECT_EQ(offer(1000.0), 0u) << i;
  EXPECT_EQ(offer(1000.0), reason::stuck);
  EXPECT_EQ(offer(1000.5), 0u);
}

TEST_F(SensorCheckTest, ASensorThatHasShownNoNoiseIsNotStuck) {
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(offer(1000.0), 0u) << i;
}

TEST_F(SensorCheckTest, RejectsNamesThatTheModelDoesNotHave) {
  try {
    SensorCheck(CheckOptions{}, {{.name = "T48", .stuck_samples = 5}}, one_sensor(1000.0));
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "sensor.name is 'T48', which the design does not have; it has T30");
  }
}

// An estimator that holds from taxi to taxi: the range is as much wider on either side as readings go beyond the trim.
TEST(SensorCheck, ReachesOverWhatThePublishedEstimatorHoldsFor) {
  const linear_model::LinearModel model = one_sensor(1000.0);
  const estimation::SensorSpan span{estimation::SensorVector::Constant(1, 400.0),
                                    estimation::SensorVector::Constant(1, 1700.0)};
  SensorCheck check{CheckOptions{}, {}, model, span};
  const auto reasons_of = [&](double value) {
    check.reset();
    Sample s;
    s.sensor_valid = 1u;
    s.sensor[0] = value;
    return check.reasons(s, 0, 1);
  };
  EXPECT_EQ(reasons_of(2299.0), 0u);
  EXPECT_EQ(reasons_of(2301.0), idl::reject_reason::range);
  EXPECT_EQ(reasons_of(-199.0), 0u);
  EXPECT_EQ(reasons_of(-201.0), idl::reject_reason::range);
}

TEST(SensorCheck, TheOperatorsLimitReplacesTheRule) {
  Sample s;
  s.sensor_valid = 1;
  s.sensor[0] = 1000.0;
  SensorCheck early(CheckOptions{}, {{.name = "T30", .stuck_samples = 5}}, one_sensor(1000.0));
  for (int i = 0; i < 4; ++i) EXPECT_EQ(early.reasons(s, 0, 1), 0u) << i;
  EXPECT_EQ(early.reasons(s, 0, 1), reason::stuck);

  SensorCheck never(CheckOptions{}, {{.name = "T30", .stuck_samples = 0}}, one_sensor(1000.0));
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    s.sensor[0] = 1000.0 + normal(random);
    never.reasons(s, 0, 1);
  }
  for (int i = 0; i < 5000; ++i) ASSERT_EQ(never.reasons(s, 0, 1), 0u) << i;
}

TEST(SensorCheck, ScalesWithNoiseWhereTheTrimIsZero) {
  SensorCheck check(CheckOptions{}, {}, one_sensor(0.0));  // sigma 5: range 60 * 5
  Sample s;
  s.sensor_valid = 1;
  s.sensor[0] = 299.0;
  EXPECT_EQ(check.reasons(s, 0, 1), 0u);
  s.sensor[0] = 301.0;
  EXPECT_EQ(check.reasons(s, 0, 1), reason::range);
}

}  // namespace
