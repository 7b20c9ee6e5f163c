// SPDX-License-Identifier: Apache-2.0
// Identified noise against the truth: linear engines whose noise is known. The model is the JT9D at cruise of the
// reference (7 sensors, 10 health parameters), noise of theory.md, section 5.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "tests/unit/tuner_design/identify/walking_engine.h"
#include "tuner_design/identify/identify_noise.h"
#include "tuner_design/identify/short_holes.h"

namespace ehm::tuner_design {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

linear_model::LinearModel cruise() {
  return linear_model::discretise(test::jt9d_cruise());
}

IdentifiedNoise identified(const linear_model::LinearModel& model, const test::KnownNoise& noise, Index samples,
                           std::uint64_t seed) {
  return identify_noise(test::walking_engine(model, noise, samples, seed), model, {});
}

/// Truth over estimate, each variance: sensors, states, the common walk.
std::vector<std::pair<double, IdentifiedVariance>> beside_truth(const IdentifiedNoise& found,
                                                                const test::KnownNoise& noise) {
  std::vector<std::pair<double, IdentifiedVariance>> all;
  for (std::size_t i = 0; i < found.sensors.size(); ++i)
    all.emplace_back(std::pow(noise.sensors(as_index(i)), 2), found.sensors[i].value());
  for (std::size_t j = 0; j < found.motion.size(); ++j)
    all.emplace_back(std::pow(noise.motion(as_index(j)), 2), found.motion[j]);
  all.emplace_back(std::pow(noise.walk(0), 2), found.walk);
  return all;
}

TEST(IdentifyNoise, FindsRWithin5PercentAndQWithin30PercentInTwentyMinutes) {
  const auto model = cruise();
  test::KnownNoise noise = test::noise_of(model, 1e-5);
  noise.sensors *= 1.3;  // not what the model says
  noise.motion *= 0.7;
  const IdentifiedNoise found = identified(model, noise, 80000, 11);
  const auto pairs = beside_truth(found, noise);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_TRUE(pairs[i].second.told);
    EXPECT_NEAR(pairs[i].second.value / pairs[i].first, 1.0, i < 7 ? 0.05 : 0.30) << i;
    EXPECT_LT(pairs[i].second.standard_error / pairs[i].second.value, i < 7 ? 0.01 : 0.15) << i;
  }
  EXPECT_TRUE(found.checks.empty());
  EXPECT_FALSE(found.walks_differ);
  EXPECT_EQ(found.selection.used, 80000);
}

TEST(IdentifyNoise, IntervalsHoldTheTruthAsOftenAsStated) {
  const auto model = cruise();
  int held = 0, all = 0;
  VectorXd mean = VectorXd::Zero(10);
  constexpr int records = 40;
  for (int i = 0; i < records; ++i) {
    const test::KnownNoise noise = test::noise_of(model, 1e-4);
    const auto pairs = beside_truth(identified(model, noise, 8000, 1000 + as_size(i)), noise);
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      const auto& [truth, found] = pairs[j];
      EXPECT_TRUE(found.told);
      held += found.low <= truth && truth <= found.high;
      ++all;
      mean(as_index(j)) += found.value / truth / records;
    }
  }
  // 400 intervals of 95 %: standard error 1.1 %
  EXPECT_NEAR(static_cast<double>(held) / all, 0.95, 0.03);
  RecordProperty("held", held);
  for (Index j = 0; j < 7; ++j) EXPECT_NEAR(mean(j), 1.0, 0.01);
  for (Index j = 7; j < 10; ++j) EXPECT_NEAR(mean(j), 1.0, 0.12);  // one record scatters by 13 to 27 %
}

TEST(IdentifyNoise, AConstantEngineHasNoWalkAndItsUpperEndHoldsThat) {
  const auto model = cruise();
  int above = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const IdentifiedNoise found = identified(model, test::noise_of(model, 0.0), 8000, 50 + seed);
    EXPECT_FALSE(found.walk.told);
    EXPECT_LT(found.walk.high, 5e-6);
    above += found.walk.value > 0.0;
  }
  EXPECT_LT(above, 9);  // at 0 in half of the records
}

TEST(IdentifyNoise, WalksOfSomeParametersAreToldAndTheOthersHaveAnUpperEndAndALikeness) {
  const auto model = cruise();
  test::KnownNoise noise = test::noise_of(model, 0.0);
  noise.walk(5) = 0.03;  // of one parameter only
  const IdentifiedNoise found = identified(model, noise, 40000, 3);
  EXPECT_TRUE(found.walks_differ);
  EXPECT_TRUE(found.walks[5].variance.told);
  EXPECT_NEAR(found.walks[5].variance.value / 9e-4, 1.0, 0.30);
  for (std::size_t i = 0; i < found.walks.size(); ++i) {
    EXPECT_GE(found.walks[i].alike, 0);
    EXPECT_GT(found.walks[i].correlation, -1.0 - 1e-9);
    if (i == 5) continue;
    EXPECT_LT(found.walks[i].variance.value, 1e-4) << i;
    EXPECT_LE(found.walks[i].variance.value, found.walks[i].variance.high);
  }
  EXPECT_GT(found.condition, 1.0);
}

TEST(IdentifyNoise, TwoParametersThatTheSensorsCannotTellApartSayWhatTheyAreLike) {
  auto model = test::made_up_model(4, 3);
  model.L.col(2) = model.L.col(1);
  model.M.col(2) = model.M.col(1);
  const IdentifiedNoise found = identified(model, test::noise_of(model, 1e-3), 20000, 8);
  EXPECT_TRUE(found.walk.told);
  EXPECT_NEAR(found.walk.value / 1e-3, 1.0, 0.30);
  EXPECT_TRUE(found.walks[0].variance.told);
  EXPECT_FALSE(found.walks[1].variance.told);
  EXPECT_FALSE(found.walks[2].variance.told);
  EXPECT_EQ(found.walks[1].alike, 2);
  EXPECT_EQ(found.walks[2].alike, 1);
  EXPECT_LT(found.walks[1].correlation, -0.99);
  EXPECT_GT(found.condition, 1e6);
}

TEST(IdentifyNoise, AParameterThatNoSensorSeesAndAStateThatNoneSeesAreLeftOut) {
  auto model = test::made_up_model(4, 3);
  model.L.col(1).setZero();
  model.M.col(1).setZero();
  model.A(0, 1) = 0.0;
  model.A(1, 0) = 0.0;
  model.C.col(1).setZero();
  const IdentifiedNoise found = identified(model, test::noise_of(model, 1e-3), 8000, 9);
  EXPECT_TRUE(found.walks[0].seen);
  EXPECT_FALSE(found.walks[1].seen);
  EXPECT_NE(found.walks[0].alike, 1);
  ASSERT_EQ(found.motion_terms.size(), 1U);
  EXPECT_EQ(found.motion_terms[0].channel, 0);
  EXPECT_NEAR(found.walk.value / 1e-3, 1.0, 0.50);
  model.L.setZero();
  model.M.setZero();
  EXPECT_THROW(identified(model, test::noise_of(model, 0.0), 8000, 9), std::invalid_argument);
}

TEST(IdentifyNoise, HoldsForAnyNumberOfSensorsAndParameters) {
  for (const int sensors : {1, 2, 5, 12}) {
    for (const int health : {1, 3, 12}) {
      const auto model = test::made_up_model(sensors, health);
      const test::KnownNoise noise = test::noise_of(model, 1e-4);
      const IdentifiedNoise found = identified(model, noise, 4000, as_size(100 * sensors + health));
      for (std::size_t i = 0; i < found.sensors.size(); ++i)
        EXPECT_NEAR(found.sensors[i]->value / std::pow(noise.sensors(as_index(i)), 2), 1.0, 0.15);
      for (const IdentifiedWalk& walk : found.walks) {
        EXPECT_GE(walk.variance.value, 0.0);
        EXPECT_TRUE(std::isfinite(walk.variance.high));
        EXPECT_GE(walk.variance.high, walk.variance.value);
      }
      EXPECT_LE(found.walk.low, 1e-4);
      EXPECT_GE(found.walk.high, 0.5e-4);
    }
  }
}

TEST(IdentifyNoise, SaysWhichNoisesAreCorrelatedOrColoured) {
  const auto model = cruise();
  const test::KnownNoise noise = test::noise_of(model, 1e-5);
  RecordedSamples record = test::walking_engine(model, noise, 20000, 21);
  const linear_model::Scaling scaling = linear_model::scaling_of(model);
  test::Random random(22);
  double coloured = 0.0;
  for (Index k = 0; k < record.sensors.cols(); ++k) {
    // common noise of as much variance as each one's own: correlation 0.5
    const double common = random.normal();
    for (const Index i : {3, 5}) record.sensors(i, k) += noise.sensors(i) * scaling.sensor(i) * common;
    coloured = 0.4 * coloured + random.normal();  // beside white noise of the same size
    record.sensors(2, k) += noise.sensors(2) * scaling.sensor(2) * coloured;
  }
  const IdentifiedNoise found = identify_noise(record, model, {});
  ASSERT_EQ(found.checks.size(), 2U);
  EXPECT_EQ(found.checks[0].sensor, 3);
  EXPECT_EQ(found.checks[0].other, 5);
  EXPECT_NEAR(found.checks[0].correlation, 0.5, 0.1);  // one step from a fit that knows no correlation
  EXPECT_EQ(found.checks[1].sensor, 2);
  EXPECT_EQ(found.checks[1].other, 2);
  EXPECT_GT(found.checks[1].correlation, 0.1);
}

TEST(IdentifyNoise, AnActuatorThatAnswersTheNoiseOfASensorChangesNothing) {
  const auto model = cruise();
  const linear_model::Scaling scaling = linear_model::scaling_of(model);
  const linear_model::LinearModel scaled = linear_model::scaled(model, scaling);
  RecordedSamples record = test::walking_engine(model, test::noise_of(model, 1e-5), 20000, 31);
  VectorXd xu = VectorXd::Zero(2);
  for (Index k = 0; k < record.sensors.cols(); ++k) {
    const double u = record.controls(0, k) - model.controls[0].trim;
    record.sensors.col(k) += scaling.sensor.cwiseProduct(scaled.C * xu + scaled.D * u);
    xu = scaled.A * xu + scaled.B * u;
    // a control that answers the measured N1
    if (k + 1 < record.sensors.cols())
      record.controls(0, k + 1) -= 0.5 * model.controls[0].trim * (record.sensors(0, k) / model.sensors[0].trim - 1.0);
  }
  const IdentifiedNoise found = identify_noise(record, model, {});
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(found.sensors[i]->value / std::pow(scaled.sensor_noise_sigma(as_index(i)), 2), 1.0, 0.05);
  EXPECT_TRUE(found.checks.empty());
}

TEST(IdentifyNoise, HeldAndRoundedSensorsGiveTheVarianceThatTheFilterCountsWith) {
  auto model = cruise();
  const double own = model.sensor_noise_sigma(3), step = own;
  model.sensor_resolution = VectorXd::Zero(7);
  model.sensor_update_period_s = VectorXd::Zero(7);
  model.sensor_resolution(3) = step;
  model.sensor_update_period_s(3) = 4 * model.sample_time_s;
  RecordedSamples record = test::walking_engine(model, test::noise_of(model, 0.0), 20000, 41);
  for (Index k = 0; k < record.sensors.cols(); ++k)
    record.sensors(3, k) = k % 4 == 0 ? step * std::round(record.sensors(3, k) / step) : record.sensors(3, k - 1);
  const IdentifiedNoise found = identify_noise(record, model, {});
  const double sigma = std::sqrt(found.sensors[3]->value) * found.scaling.sensor(3);
  EXPECT_NEAR(sigma / linear_model::counted_sigma(model, 3, own), 1.0, 0.04);
}

TEST(IdentifyNoise, WritesWhatWasToldIntoTheModelAndNoMoreThanTheUpperEndOfTheRest) {
  const auto model = cruise();
  test::KnownNoise noise = test::noise_of(model, 0.0);
  noise.sensors *= 2.0;
  noise.motion(1) = 0.0;  // the second state does not move by itself: not told
  noise.motion(0) *= 3.0;
  const IdentifiedNoise found = identified(model, noise, 20000, 61);
  const linear_model::LinearModel written = with_identified_noise(model, found);
  for (Index i = 0; i < 7; ++i) EXPECT_NEAR(written.sensor_noise_sigma(i) / model.sensor_noise_sigma(i), 2.0, 0.05);
  EXPECT_NEAR(written.process_noise(0, 0) / model.process_noise(0, 0), 9.0, 2.7);
  EXPECT_FALSE(found.motion[1].told);
  EXPECT_GT(written.process_noise(1, 1), 0.0);
  EXPECT_LT(written.process_noise(1, 1), 0.3 * model.process_noise(1, 1));
}

TEST(IdentifyNoise, ALinkThatLosesOneSampleInAHundredCostsAPercent) {
  const auto model = cruise();
  const test::KnownNoise noise = test::noise_of(model, 1e-4);
  RecordedSamples record = test::walking_engine(model, noise, 40000, 66);
  test::Random random(67);
  Index lost = 0;
  for (Index k = 10; k < 39990; k += 10) {
    if (random.uniform(0.0, 1.0) > 0.1) continue;
    ++lost;
    record.sensors.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    record.controls.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const IdentifiedNoise found = identify_noise(record, model, {});
  EXPECT_EQ(found.mended, lost);
  EXPECT_EQ(found.selection.segments.size(), 1U);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(found.sensors[i]->value / std::pow(noise.sensors(as_index(i)), 2), 0.99, 0.04);
  EXPECT_NEAR(found.walk.value / 1e-4, 1.0, 0.30);
  for (const NoiseCheck& check : found.checks)
    ADD_FAILURE() << check.sensor << " and " << check.other << ": " << check.correlation;
}

TEST(ShortHoles, AreMendedBetweenNeighboursButNotAcrossGapsNorWhereTheyAreManyOrLong) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  RecordedSamples record;
  record.flight = Eigen::MatrixXd::Zero(3, 1000);
  record.controls = Eigen::MatrixXd::Constant(1, 1000, 5.0);
  record.sensors = Eigen::RowVectorXd::LinSpaced(1000, 0.0, 999.0).replicate(2, 1);
  record.sensors.row(0).segment(10, 3).setConstant(nan);
  record.sensors.row(0).segment(20, 4).setConstant(nan);  // too long
  record.sensors(0, 30) = record.sensors(0, 0) = record.sensors(0, 999) = nan;
  record.gap_after = {30};
  record.sensors.row(1).head(30).setConstant(nan);  // 3 %
  record.sensors(1, 500) = nan;
  record.controls(0, 40) = nan;
  EXPECT_EQ(mend_short_holes(record), 4);
  for (const Index k : {10, 11, 12}) EXPECT_DOUBLE_EQ(record.sensors(0, k), static_cast<double>(k));
  EXPECT_EQ(record.controls(0, 40), 5.0);
  for (const Index k : {0, 20, 23, 30, 999}) EXPECT_TRUE(std::isnan(record.sensors(0, k))) << k;
  EXPECT_TRUE(std::isnan(record.sensors(1, 500)));
}

TEST(IdentifyNoise, TheSameRecordGivesTheSameBits) {
  const auto model = cruise();
  const RecordedSamples record = test::walking_engine(model, test::noise_of(model, 1e-4), 4000, 71);
  const IdentifiedNoise a = identify_noise(record, model, {}), b = identify_noise(record, model, {});
  EXPECT_EQ(a.walk.value, b.walk.value);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(a.sensors[i]->value, b.sensors[i]->value);
}

TEST(IdentifyNoise, TooFewSamplesAndAStuckSensorAreNamed) {
  const auto model = cruise();
  const auto message = [&](const RecordedSamples& record) -> std::string {
    try {
      identify_noise(record, model, {});
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  RecordedSamples record = test::walking_engine(model, test::noise_of(model, 0.0), 1999, 81);
  EXPECT_NE(message(record).find("has 1999 steady samples"), std::string::npos);
  record = test::walking_engine(model, test::noise_of(model, 0.0), 4000, 81);
  record.sensors.row(4).setConstant(1480.0);
  EXPECT_NE(message(record).find("sensor P30 reads one value throughout"), std::string::npos);
}

}  // namespace
}  // namespace ehm::tuner_design
