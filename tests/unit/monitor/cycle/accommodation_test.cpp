// SPDX-License-Identifier: Apache-2.0
// What becomes of the estimate when a sensor is named faulty: a step below the published sigma, for every sensor and
// size; the sensor stays out while it is biased, and comes back when it is well.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "deploy/runtime/numbers/index.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tuner_design/design/design_tuner.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

class Accommodation : public testing::Test {
 protected:
  explicit Accommodation(std::shared_ptr<const design::Design> design = test::made_up_design(), std::uint64_t seed = 41)
      : design_(std::move(design)), cycle_(design_, CycleOptions{}) {
    test::Random random(seed);
    flight_.emplace(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)), seed);
    fly(2000, 0, 0.0);
  }
  /// Flies with `sigmas` of bias on one sensor; notes the largest step of an estimate at a change of the set.
  void fly(int samples, int sensor, double sigmas) {
    for (int k = 0; k < samples; ++k) {
      Sample s = flight_->next();
      s.sensor[as_size(sensor)] += sigmas * design_->model.sensor_noise_sigma(sensor);
      const auto before = cycle_.watch().filter().sensor_set();
      const estimation::HealthVector health = cycle_.watch().filter().health();
      const estimation::AuxiliaryVector auxiliary = cycle_.watch().filter().auxiliary();
      cycle_.process(s);
      cycle_.clear_events();
      if (cycle_.watch().filter().sensor_set() == before) continue;
      const auto& error = cycle_.watch().error();
      step_ = std::max(
          {step_,
           ((cycle_.watch().filter().health() - health).cwiseAbs().cwiseQuotient(error.health_sigma())).maxCoeff(),
           ((cycle_.watch().filter().auxiliary() - auxiliary).cwiseAbs().cwiseQuotient(error.auxiliary_sigma()))
               .maxCoeff()});
    }
  }
  bool used(int sensor) const { return cycle_.result().estimate.sensors[as_size(sensor)]; }

  std::shared_ptr<const design::Design> design_;
  MonitorCycle cycle_;
  std::optional<test::Flight> flight_;
  double step_ = 0.0;  ///< published sigmas
};

TEST_F(Accommodation, EverySensorAndSizeLeavesAndReturnsWithoutAStep) {
  int declared = 0;
  for (int sensor = 0; sensor < 7; ++sensor) {
    for (const double sigmas : {4.0, -5.0, 10.0, -25.0}) {
      fly(200, sensor, sigmas);
      if (!used(sensor)) ++declared;
      if (std::abs(sigmas) >= 10.0) {
        EXPECT_FALSE(used(sensor)) << sensor << ' ' << sigmas;
      }
      fly(900, sensor, 0.0);
      EXPECT_TRUE(used(sensor)) << sensor << ' ' << sigmas;
      fly(300, sensor, 0.0);
      EXPECT_LT(step_, 1.0) << sensor << ' ' << sigmas;
    }
  }
  EXPECT_GE(declared, 22);  // of 28; the made-up engine sees some biases of 4 and 5 sigma less well
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_LT(std::abs(cycle_.watch().filter().health()(i) - flight_->health()(i)),
              3.0 * cycle_.watch().error().health_sigma()(i));
}

TEST_F(Accommodation, ABiasedSensorStaysOutForTenMinutesAndTheEstimateWithinItsSigma) {
  fly(40'000, 1, 5.0);
  EXPECT_FALSE(used(1));
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_LT(std::abs(cycle_.watch().filter().health()(i) - flight_->health()(i)),
              3.0 * cycle_.watch().error().health_sigma()(i));
}

/// A fleet so little worn that drifts stand out.
class TightFleet : public Accommodation {
 protected:
  TightFleet() : Accommodation(design_of_a_tight_fleet()) {}

 private:
  static std::shared_ptr<const design::Design> design_of_a_tight_fleet() {
    auto model = test::made_up_model(7, 10);
    model.health_sigma *= 0.25;
    return std::make_shared<const design::Design>(tuner_design::design_tuner(model, design::DesignOptions{}));
  }
};

TEST_F(TightFleet, ADriftThatEndsIsNoNewFaultAndTheEstimateFollowsAtOnce) {
  const SlowBias watch(FaultOptions{}, slow_bias_table(*design_));
  int drifted = 0;
  for (int sensor = 0; sensor < 7; ++sensor) {
    if (!watch.watches(sensor)) continue;
    ++drifted;
    for (int k = 0; k < 4000; ++k) fly(1, sensor, 6.0 * k / 4000.0);
    ASSERT_TRUE(used(sensor));
    fly(300, sensor, 0.0);
    EXPECT_TRUE(used(sensor)) << sensor;
    for (Eigen::Index i = 0; i < 10; ++i)
      EXPECT_LT(std::abs(cycle_.watch().filter().health()(i) - flight_->health()(i)),
                3.0 * cycle_.watch().error().health_sigma()(i))
          << sensor << ' ' << i;
    fly(1000, sensor, 0.0);
    fly(200, sensor, 10.0);  // and a new fault is one
    EXPECT_FALSE(used(sensor)) << sensor;
    fly(1500, sensor, 0.0);
  }
  EXPECT_EQ(drifted, 2);
}

TEST_F(Accommodation, ADropoutLeavesTheEstimateWhereItWas) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  for (int sensor = 0; sensor < 7; ++sensor) {
    fly(100, sensor, nothing);
    EXPECT_FALSE(used(sensor));
    fly(600, sensor, 0.0);
    EXPECT_TRUE(used(sensor));
    fly(500, sensor, 0.0);
  }
  EXPECT_LT(step_, 1.0);
}

}  // namespace
