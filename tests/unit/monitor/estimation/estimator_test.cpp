// SPDX-License-Identifier: Apache-2.0
// What every estimator of the table promises (monitor/estimation/estimator.h): one suite, a row for each.

#include "monitor/estimation/estimator.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "deploy/runtime/numbers/index.h"
#include "monitor/design/make_estimator.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tests/unit/monitor/estimation/allocation_counter.h"

namespace {

using namespace ehm;
using estimation::Conditions;
using estimation::Estimate;
using estimation::Estimator;
using estimation::SensorMask;

constexpr int sensors = 7, health = 10;

std::unique_ptr<Estimator> make(const std::string& name, const monitor::EstimatorOptions& options = {}) {
  return design::make_estimator(name, *test::made_up_design(), options, {});
}

/// An estimator of the table, and the options that it is made with.
struct Row {
  std::string label, name;
  monitor::EstimatorOptions options;
};

Row constrained(const std::string& label, const std::string& of, const std::string& way, bool feeds_back) {
  Row row{"constrained_" + label, design::constrained_name, {}};
  row.options.constrained_of = of;
  row.options.constraint = way;
  row.options.constraint_feeds_back = feeds_back;
  return row;
}

/// With a memory that the test's flights are long against.
Row forgetful(const std::string& name, double memory_s) {
  Row row{name + "_forgetful", name, {}};
  row.options.memory_s = memory_s;
  return row;
}

SensorMask all_sensors() {
  return SensorMask((1u << sensors) - 1);
}

Conditions conditions_of(const monitor::Sample& sample) {
  Conditions now{sample.flight, estimation::ActuatorVector(1)};
  now.actuators(0) = sample.actuator[0];
  return now;
}

/// Flies an estimator as the data path does.
class Flown {
 public:
  Flown(Estimator& estimator, test::Flight& flight) : estimator_(estimator), flight_(flight) {}
  /// Of an estimator that has flown before, lastly in these conditions.
  Flown(Estimator& estimator, test::Flight& flight, const Conditions& before)
      : estimator_(estimator), flight_(flight), before_(before), begun_(true) {}

  void fly(int samples, SensorMask available = all_sensors()) {
    for (int k = 0; k < samples; ++k) {
      const monitor::Sample sample = flight_.next();
      const Conditions now = conditions_of(sample);
      if (!begun_) before_ = now;
      begun_ = true;
      estimator_.use(available);
      estimator_.predict(before_, 1);
      before_ = now;
      estimation::SensorVector y(sensors);
      for (int i = 0; i < sensors; ++i)
        y(i) = available[as_size(i)] ? sample.sensor[as_size(i)] : std::numeric_limits<double>::quiet_NaN();
      estimator_.innovate(y, now);
      estimator_.update(available, 1);
    }
  }
  const Conditions& before() const { return before_; }

 private:
  Estimator& estimator_;
  test::Flight& flight_;
  Conditions before_;
  bool begun_ = false;
};

test::Flight engine_of_the_fleet(std::uint64_t seed) {
  test::Random random(1000 + seed);
  const auto& model = test::made_up_design()->model;
  return {model, model.health_sigma.cwiseProduct(random.normal_vector(health)), seed};
}

bool same(const Estimate& a, const Estimate& b) {
  return a.health == b.health && a.health_sigma == b.health_sigma && a.auxiliary == b.auxiliary &&
         a.auxiliary_sigma == b.auxiliary_sigma && a.tuners == b.tuners && a.sensors == b.sensors &&
         a.settled == b.settled;
}

class EveryEstimator : public testing::TestWithParam<Row> {
 protected:
  std::unique_ptr<Estimator> fresh() const { return make(GetParam().name, GetParam().options); }
  std::unique_ptr<Estimator> estimator_ = fresh();
};

TEST_P(EveryEstimator, StartsAtThePriorAndIsAsNewAfterAReset) {
  const auto& model = test::made_up_design()->model;
  const Estimate fresh = estimator_->estimate();
  EXPECT_TRUE(fresh.health.isZero());
  EXPECT_TRUE(fresh.health_sigma.isApprox(model.health_sigma, 1e-9));
  EXPECT_EQ(fresh.sensors, all_sensors());
  EXPECT_FALSE(fresh.settled);
  auto flight = engine_of_the_fleet(1);
  Flown(*estimator_, flight).fly(200);
  EXPECT_FALSE(same(estimator_->estimate(), fresh));
  estimator_->widen(3.0);
  estimator_->reset();
  EXPECT_TRUE(same(estimator_->estimate(), fresh));
}

TEST_P(EveryEstimator, TheSameSamplesGiveTheSameBitsAndACloneIsANewOne) {
  auto flight = engine_of_the_fleet(2), again = engine_of_the_fleet(2);
  Flown(*estimator_, flight).fly(300);
  const auto clone = estimator_->clone();
  EXPECT_TRUE(same(clone->estimate(), fresh()->estimate()));
  Flown(*clone, again).fly(300);
  EXPECT_TRUE(same(clone->estimate(), estimator_->estimate()));
}

// Of a constrained one this says nothing new: it has not settled after 400 samples and binds nobody, so that the sigmas
// are those of the one inside. Later its errors are not those that it states: a truncated Gaussian is none, a
// projection keeps a sigma that is too large, and against its own noisy estimates it is biased
// (constrained/constrained_estimator_test.cpp).
TEST_P(EveryEstimator, ErrorsOverTheFleetAreThoseThatItStates) {
  constexpr int engines = 300;
  constexpr std::array<int, 3> samples{1, 40, 400};
  std::array<Eigen::ArrayXd, samples.size()> ratio;
  ratio.fill(Eigen::ArrayXd::Zero(health));
  for (int engine = 0; engine < engines; ++engine) {
    auto flight = engine_of_the_fleet(static_cast<std::uint64_t>(engine));
    flight.start_moving();
    estimator_->reset();
    Flown flown(*estimator_, flight);
    for (std::size_t at = 0; at < samples.size(); ++at) {
      flown.fly(samples[at] - (at == 0 ? 0 : samples[at - 1]));
      const Estimate& estimate = estimator_->estimate();
      ratio[at] += ((estimate.health - flight.health()).array() / estimate.health_sigma.array()).square();
    }
  }
  // A chi-square with 300 degrees of freedom over 300 has the standard deviation sqrt(2/300) = 0.08.
  for (std::size_t at = 0; at < samples.size(); ++at)
    for (Eigen::Index i = 0; i < health; ++i)
      EXPECT_NEAR(ratio[at](i) / engines, 1.0, 4.0 * 0.082) << samples[at] << " samples, parameter " << i;
}

TEST_P(EveryEstimator, InnovationsAreAsLargeAsTheirVariance) {
  constexpr int engines = 20, samples = 400;
  double sum = 0.0;
  for (std::uint64_t engine = 0; engine < engines; ++engine) {
    auto flight = engine_of_the_fleet(500 + engine);
    flight.start_moving();
    estimator_->reset();
    Flown flown(*estimator_, flight);
    flown.fly(4000);
    for (int k = 0; k < samples; ++k) {
      flown.fly(1);
      const estimation::Innovation& nu = estimator_->innovation();
      sum += nu.value.cwiseAbs2().cwiseQuotient(nu.variance).mean() / (engines * samples);
    }
  }
  // 56 000 values, nearly white. A filter that counts with changes of health, which this engine has not, states more.
  EXPECT_LT(sum, 1.03);
  EXPECT_GT(sum, 0.90);
}

TEST_P(EveryEstimator, WithoutASensorItStaysFiniteHonestAndLessCertain) {
  const auto without = SensorMask(all_sensors()).reset(3);
  double worst = 0.0;
  for (std::uint64_t engine = 0; engine < 20; ++engine) {
    auto flight = engine_of_the_fleet(100 + engine);
    const auto with_all = estimator_->clone();
    auto twin = engine_of_the_fleet(100 + engine);
    estimator_->reset();
    Flown(*estimator_, flight).fly(1500, without);
    Flown(*with_all, twin).fly(1500);
    const Estimate& estimate = estimator_->estimate();
    EXPECT_EQ(estimate.sensors, without);
    ASSERT_TRUE(estimate.health.allFinite() && estimate.auxiliary.allFinite());
    EXPECT_GT(estimate.health_sigma.squaredNorm(), with_all->estimate().health_sigma.squaredNorm());
    worst =
        std::max(worst, (estimate.health - flight.health()).cwiseAbs().cwiseQuotient(estimate.health_sigma).maxCoeff());
  }
  EXPECT_LT(worst, 4.5);  // of 200 values; 4 sigma is one in 16 000
}

TEST_P(EveryEstimator, ALostSampleIsPredictedOver) {
  auto flight = engine_of_the_fleet(7), twin = engine_of_the_fleet(7);
  const auto other = estimator_->clone();
  Flown flown(*estimator_, flight), lossy(*other, twin);
  flown.fly(100);
  lossy.fly(100);
  const Conditions still = conditions_of(flight.next());
  twin.next();
  // Two steps at once are two predictions with nothing between.
  const estimation::SensorVector y = estimation::SensorVector::Zero(sensors);
  estimator_->predict(still, 2);
  other->predict(still, 1);
  other->update({}, 1);
  other->predict(still, 1);
  estimator_->innovate(y, still);
  other->innovate(y, still);
  EXPECT_TRUE(estimator_->innovation().value.isApprox(other->innovation().value, 1e-12));
}

TEST_P(EveryEstimator, IsWidenedForAnEngineBeyondTheFleet) {
  auto flight = engine_of_the_fleet(8);
  Flown(*estimator_, flight).fly(500);
  const Estimate before = estimator_->estimate();
  estimator_->widen(4.0);
  EXPECT_EQ(estimator_->estimate().health, before.health);
  for (Eigen::Index i = 0; i < health; ++i) {
    EXPECT_GE(estimator_->estimate().health_sigma(i), before.health_sigma(i));
    EXPECT_LE(estimator_->estimate().health_sigma(i), 4.0001 * before.health_sigma(i));
  }
  estimator_->widen(1.0);
  EXPECT_EQ(estimator_->estimate().health_sigma, before.health_sigma);
}

TEST_P(EveryEstimator, GoesOnFromASavedStateWithTheSameBits) {
  const auto without = SensorMask(all_sensors()).reset(3);
  for (const int flown : {1, 40, 6000}) {  // cold, converging, and settled but for the time-varying filter's memory
    for (const SensorMask available : {all_sensors(), without}) {
      auto flight = engine_of_the_fleet(11);
      estimator_->reset();
      Flown flown_on(*estimator_, flight);
      flown_on.fly(flown, available);
      estimation::EstimatorState state;
      estimator_->save(state);
      const auto successor = fresh();
      ASSERT_TRUE(successor->restore(state));
      EXPECT_EQ(successor->estimate().health, estimator_->estimate().health);
      EXPECT_EQ(successor->estimate().health_sigma, estimator_->estimate().health_sigma);
      auto twin = flight;
      Flown goes_on(*successor, twin, flown_on.before());
      for (int k = 0; k < 20; ++k) {
        flown_on.fly(1, available);
        goes_on.fly(1, available);
        ASSERT_TRUE(same(successor->estimate(), estimator_->estimate())) << flown << " + " << k;
        ASSERT_EQ(successor->innovation().value.head(3), estimator_->innovation().value.head(3));
        ASSERT_EQ(successor->innovation().variance, estimator_->innovation().variance);
      }
    }
  }
}

TEST_P(EveryEstimator, AStateThatIsNotItsOwnChangesNothing) {
  auto flight = engine_of_the_fleet(12);
  Flown(*estimator_, flight).fly(50);
  const Estimate before = estimator_->estimate();
  estimation::EstimatorState state;
  estimator_->save(state);
  const auto refused = [&](auto&& change) {
    estimation::EstimatorState broken = state;
    change(broken);
    return !estimator_->restore(broken) && same(estimator_->estimate(), before);
  };
  EXPECT_TRUE(refused([](auto& s) { s.estimate.conservativeResize(s.estimate.size() - 1); }));
  EXPECT_TRUE(refused([](auto& s) { s.error.mean.conservativeResize(s.error.mean.rows(), s.error.mean.cols() - 1); }));
  EXPECT_TRUE(refused([](auto& s) { s.error.covariance.setIdentity(3, 3); }));
  EXPECT_TRUE(refused([](auto& s) { s.error.remaining = 1'000'000'000; }));
  EXPECT_TRUE(refused([](auto& s) { s.error.remaining = -1; }));
  EXPECT_TRUE(refused([](auto& s) { s = {}; }));
}

TEST_P(EveryEstimator, ItsCovarianceOfHealthHasItsSigmasOnTheDiagonal) {
  auto flight = engine_of_the_fleet(13);
  Flown(*estimator_, flight).fly(300);
  estimator_->widen(2.0);
  const estimation::HealthCovariance covariance = estimator_->health_covariance();
  if (covariance.size() == 0) return;  // it need not know
  ASSERT_EQ(covariance.rows(), health);
  const estimation::HealthVector variance = estimator_->estimate().health_sigma.cwiseAbs2();
  for (Eigen::Index i = 0; i < health; ++i) EXPECT_NEAR(covariance(i, i) / variance(i), 1.0, 1e-9) << i;
  EXPECT_LT((covariance - covariance.transpose()).cwiseAbs().maxCoeff(), 1e-9 * covariance.cwiseAbs().maxCoeff());
}

TEST_P(EveryEstimator, GoesOnFromACorrectedHealthOrSaysThatItCannot) {
  auto flight = engine_of_the_fleet(14);
  Flown flown(*estimator_, flight);
  flown.fly(300);
  const Estimate before = estimator_->estimate();
  estimation::HealthVector wanted = before.health;
  wanted(2) -= 0.3 * before.health_sigma(2);
  if (!estimator_->correct_health(wanted)) {
    EXPECT_TRUE(same(estimator_->estimate(), before));
    return;
  }
  EXPECT_LT((estimator_->estimate().health - wanted).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_EQ(estimator_->estimate().health_sigma, before.health_sigma);
  flown.fly(1);
  // one sample does not take back what it was told
  EXPECT_LT(estimator_->estimate().health(2), before.health(2) - 0.1 * before.health_sigma(2));
}

TEST_P(EveryEstimator, KnowsHowFarItsPointIs) {
  auto flight = engine_of_the_fleet(9);
  Conditions here = conditions_of(flight.next());
  here.actuators(0) = test::made_up_design()->model.controls[0].trim;
  EXPECT_EQ(estimator_->distance(here), 0.0);
  here.actuators(0) *= 1.30;  // twice the 15 percent of validity.actuator_percent
  EXPECT_NEAR(estimator_->distance(here), 2.0, 1e-9);
}

TEST_P(EveryEstimator, AllocatesNothingAfterConstruction) {
  auto flight = engine_of_the_fleet(10);
  const monitor::Sample sample = flight.next();
  const Conditions now = conditions_of(sample);
  estimation::SensorVector y(sensors);
  for (int i = 0; i < sensors; ++i) y(i) = sample.sensor[as_size(i)];
  estimation::EstimatorState state;
  const long before = test::allocation_count();
  for (int k = 0; k < 50; ++k) {
    estimator_->use(k < 20 ? all_sensors() : SensorMask(all_sensors()).reset(2));
    estimator_->predict(now, k == 30 ? 3 : 1);
    estimator_->innovate(y, now);
    estimator_->update(k == 40 ? SensorMask{} : all_sensors(), 1);
    estimator_->widen(k < 45 ? 1.0 : 2.0);
    if (estimator_->distance(now) > 1e9) break;
    if (k == 10) estimator_->save(state);
    if (k == 25) {
      EXPECT_TRUE(estimator_->restore(state));
    }
  }
  estimator_->reset();
  EXPECT_EQ(test::allocation_count() - before, 0);
}

std::vector<Row> every_row() {
  std::vector<Row> rows;
  for (const design::EstimatorKind& kind : design::estimator_kinds())
    // those that fly engines have their own: onboard/, nonlinear/ and schedule/
    if (kind.basis == design::EstimatorBasis::design) rows.push_back({kind.name, kind.name, {}});
  for (const Row& row : {constrained("clamped_tuner", "tuner", "projection_identity", false),
                         constrained("truncated_gauss_markov", "gauss_markov", "truncation", false),
                         constrained("gauss_markov_fed_back", "gauss_markov", "projection", true),
                         constrained("truncated", "time_varying", "truncation", false),
                         constrained("fed_back", "time_varying", "projection", true),
                         constrained("clamped_wls", "wls", "projection_identity", false),
                         constrained("rls_fed_back", "rls", "projection", true), forgetful("rls", 5.0)})
    rows.push_back(row);
  return rows;
}

INSTANTIATE_TEST_SUITE_P(Table, EveryEstimator, testing::ValuesIn(every_row()),
                         [](const auto& row) { return row.param.label; });

TEST(EstimatorTable, NamesAreRefusedWithWhatIsAllowed) {
  const auto refused = [](const std::string& published, const std::string& shadow) -> std::string {
    try {
      monitor::EstimatorOptions options;
      options.published = published;
      options.shadow = shadow;
      design::shadow_names(options);
    } catch (const std::invalid_argument& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(refused("tuner", ""), "");
  EXPECT_EQ(refused("tuner", "gauss_markov,time_varying"), "");
  EXPECT_EQ(refused("time_varying", "tuner"), "");
  EXPECT_EQ(
      refused("tuner", "kalman"),
      "'kalman' is no estimator; allowed: tuner, gauss_markov, time_varying, map, wls, rls, onboard, scheduled, ekf, "
      "iekf, clipped_ekf, ukf, particle, ekpf, cekpf, constrained");
  EXPECT_THAT(refused("tuner", "gauss_markov,"), testing::HasSubstr("'' is no estimator"));
  EXPECT_THAT(refused("tuner", "tuner"), testing::HasSubstr("published already"));
  EXPECT_THAT(refused("tuner", "gauss_markov,gauss_markov"), testing::HasSubstr("stands twice"));
  EXPECT_THROW(make("kalman"), std::invalid_argument);
}

}  // namespace
