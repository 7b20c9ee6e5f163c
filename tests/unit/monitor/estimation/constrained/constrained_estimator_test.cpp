// SPDX-License-Identifier: Apache-2.0
// What a constrained estimator promises beside the suite of all of them (../estimator_test.cpp): once it has settled no
// parameter gets better, until maintenance; a wrong option is named.

#include "monitor/estimation/constrained/constrained_estimator.h"

#include <gmock/gmock.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/make_estimator.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using estimation::ConstrainedEstimator;
using estimation::Estimate;
using estimation::Estimator;
using estimation::HealthVector;
using monitor::EstimatorOptions;

constexpr int sensors = 7, health = 10;

EstimatorOptions options_of(const std::string& way, bool feeds_back, const std::string& of = "time_varying") {
  EstimatorOptions options;
  options.constrained_of = of;
  options.constraint = way;
  options.constraint_feeds_back = feeds_back;
  options.constraint_margin_sigma = 0.0;
  options.wear_raises = "h3";
  return options;
}

std::unique_ptr<Estimator> make(const EstimatorOptions& options, const std::string& name = design::constrained_name) {
  return design::make_estimator(name, *test::made_up_design(), options, {});
}

/// One sample with all sensors.
void fly(Estimator& estimator, test::Flight& flight) {
  const monitor::Sample sample = flight.next();
  estimation::Conditions now{sample.flight, estimation::ActuatorVector(1)};
  now.actuators(0) = sample.actuator[0];
  estimation::SensorVector y(sensors);
  for (int i = 0; i < sensors; ++i) y(i) = sample.sensor[as_size(i)];
  estimator.use(estimation::SensorMask((1u << sensors) - 1));
  estimator.predict(now, 1);
  estimator.innovate(y, now);
  estimator.update(estimation::SensorMask((1u << sensors) - 1), 1);
}

test::Flight some_engine(std::uint64_t seed) {
  test::Random random(2000 + seed);
  const auto& model = test::made_up_design()->model;
  return {model, model.health_sigma.cwiseProduct(random.normal_vector(health)), seed};
}

void settle(Estimator& estimator, test::Flight& flight) {
  for (int k = 0; k < 20000 && !estimator.estimate().settled; ++k) fly(estimator, flight);
  ASSERT_TRUE(estimator.estimate().settled);
}

TEST(ConstrainedEstimator, OnceSettledNoParameterGetsBetterAndBeforeItIsTheOneInside) {
  for (const char* way : {"projection", "projection_identity", "truncation"}) {
    for (const bool feeds_back : {false, true}) {
      if (feeds_back && std::string(way) == "truncation") continue;  // refused
      const auto constrained = make(options_of(way, feeds_back)), inside = make({}, "time_varying");
      auto flight = some_engine(1), twin = some_engine(1);
      while (!constrained->estimate().settled) {
        EXPECT_EQ(constrained->estimate().health, inside->estimate().health);
        fly(*constrained, flight);
        fly(*inside, twin);
      }
      HealthVector last = constrained->estimate().health;
      for (int k = 0; k < 500; ++k) {
        fly(*constrained, flight);
        const HealthVector& now = constrained->estimate().health;
        for (Eigen::Index i = 0; i < health; ++i)
          ASSERT_LE(i == 3 ? last(i) - now(i) : now(i) - last(i), 0.0) << way << ", parameter " << i;
        last = now;
      }
      EXPECT_NE(last, inside->estimate().health);
    }
  }
}

TEST(ConstrainedEstimator, FollowsWear) {
  const auto constrained = make(options_of("projection", false, "gauss_markov"));
  auto flight = some_engine(2);
  settle(*constrained, flight);
  const HealthVector before = constrained->estimate().health;
  flight.set_health(flight.health() + Eigen::VectorXd::Unit(health, 5) * -0.02);
  for (int k = 0; k < 4000; ++k) fly(*constrained, flight);
  EXPECT_LT(constrained->estimate().health(5), before(5) - 0.004);
}

TEST(ConstrainedEstimator, ItsBoundStaysBehindByTheMargin) {
  EstimatorOptions options = options_of("projection", false);
  options.constraint_margin_sigma = 2.0;
  const auto made = make(options);
  auto& constrained = dynamic_cast<ConstrainedEstimator&>(*made);
  auto flight = some_engine(5);
  settle(constrained, flight);
  const Estimate& estimate = constrained.estimate();
  EXPECT_NEAR(constrained.constraint().upper()(0), estimate.health(0) + 2.0 * estimate.health_sigma(0), 1e-12);
  EXPECT_NEAR(constrained.constraint().lower()(3), estimate.health(3) - 2.0 * estimate.health_sigma(3), 1e-12);
}

// Nothing to be gained there, and with the margin next to nothing lost: the ratchet holds still.
TEST(ConstrainedEstimator, CostsAnEngineThatDoesNotWearNextToNothing) {
  constexpr std::uint64_t engines = 10;
  constexpr int samples = 3000;
  for (const char* of : {"time_varying", "gauss_markov", "tuner"}) {
    for (const char* way : {"projection", "projection_identity", "truncation"}) {
      EstimatorOptions options = options_of(way, false, of);
      options.constraint_margin_sigma = EstimatorOptions().constraint_margin_sigma;
      const auto constrained = make(options), inside = make({}, of);
      double error = 0.0, error_inside = 0.0;
      for (std::uint64_t seed = 0; seed < engines; ++seed) {
        auto flight = some_engine(100 + seed), twin = some_engine(100 + seed);
        constrained->reset();
        inside->reset();
        settle(*constrained, flight);
        settle(*inside, twin);
        for (int k = 0; k < samples; ++k) {
          fly(*constrained, flight);
          fly(*inside, twin);
        }
        error += (constrained->estimate().health - flight.health()).squaredNorm();
        error_inside += (inside->estimate().health - twin.health()).squaredNorm();
      }
      EXPECT_LT(error, 1.05 * error_inside) << way << " of " << of;
    }
  }
}

TEST(ConstrainedEstimator, AResetAndAKnownStartOpenTheBox) {
  const auto made = make(options_of("projection", false));
  auto& constrained = dynamic_cast<ConstrainedEstimator&>(*made);
  auto flight = some_engine(3);
  settle(constrained, flight);
  EXPECT_TRUE(constrained.constraint().bounds().allFinite());
  constrained.reset();
  EXPECT_TRUE(constrained.constraint().bounds().array().isInf().all());
}

TEST(ConstrainedEstimator, TheTruncatedSigmaIsSmallerAndThatOfAProjectionIsTheOneInside) {
  const auto truncated = make(options_of("truncation", false)), projected = make(options_of("projection", false)),
             inside = make({}, "time_varying");
  auto first = some_engine(4), second = some_engine(4), third = some_engine(4);
  settle(*truncated, first);
  settle(*projected, second);
  settle(*inside, third);
  fly(*truncated, first);
  fly(*projected, second);
  fly(*inside, third);
  EXPECT_EQ(projected->estimate().health_sigma, inside->estimate().health_sigma);
  for (Eigen::Index i = 0; i < health; ++i)
    EXPECT_LT(truncated->estimate().health_sigma(i), inside->estimate().health_sigma(i));
}

std::string refused(const EstimatorOptions& options) {
  try {
    make(options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(ConstrainedEstimator, AWrongOptionIsNamed) {
  EXPECT_EQ(refused(options_of("projection", true)), "");
  EXPECT_THAT(refused(options_of("projection", false, "constrained")),
              testing::StartsWith("'estimator.constrained_of' is 'constrained'; allowed: one of the others, tuner, "));
  EXPECT_EQ(refused(options_of("clip", false)),
            "'estimator.constraint' is 'clip'; allowed: projection, projection_identity, truncation");
  EXPECT_EQ(refused(options_of("projection", true, "tuner")),
            "'estimator.constraint_feeds_back' is true, but tuner cannot go on from any health; allowed: false");
  EXPECT_THAT(refused(options_of("truncation", true)), testing::HasSubstr("= truncation: false"));
  EstimatorOptions options = options_of("projection", false);
  options.wear_raises = "h3,hpt_flow";
  EXPECT_EQ(refused(options), "'estimator.wear_raises' names 'hpt_flow', no health parameter of the design");
}

}  // namespace
