// SPDX-License-Identifier: Apache-2.0
// Estimates that no engine of the fleet has: said, widened, withheld; and an engine of the fleet is never touched.

#include "monitor/diagnosis/fleet_watch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "monitor/diagnosis/quantiles.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

int count(const EventList& events, idl::EventKind kind, bool raised) {
  return static_cast<int>(std::count_if(events.begin(), events.end(),
                                        [&](const Event& e) { return e.kind == kind && e.raised == raised; }));
}

class FleetWatchTest : public testing::Test {
 protected:
  FleetWatchTest() : design_(test::made_up_design()), cycle_(design_, CycleOptions{}) {}

  /// `percent_a_second` is added to every sensor's reading, in percent of its trim, or to every health parameter.
  void drift(test::Flight& flight, double seconds, double sensors_percent_a_second, double health_sigmas_a_second) {
    const double dt = design_->model.sample_time_s;
    const Eigen::VectorXd h = flight.health();
    Eigen::VectorXd direction = design_->model.health_sigma;
    for (Eigen::Index i = 1; i < direction.size(); i += 2) direction(i) *= -1.0;
    const int samples = static_cast<int>(seconds / dt);
    for (int k = 0; k < samples; ++k) {
      flight.set_health(h + health_sigmas_a_second * dt * k * direction);
      Sample s = flight.next();
      for (std::size_t i = 0; i < design_->model.sensors.size(); ++i)
        s.sensor[i] += 0.01 * sensors_percent_a_second * dt * k * design_->model.sensors[i].trim;
      cycle_.process(s);
      note(flight);
    }
  }
  /// Errors of what is published, in published sigmas.
  void note(const test::Flight& flight) {
    if (!cycle_.result().estimates) return;
    ++published_;
    const Eigen::VectorXd error = cycle_.watch().filter().health() - flight.health();
    const Eigen::VectorXd of_the_fleet = cycle_.watch().filter().health_sigma_total();
    worst_of_fleets_ = std::max(worst_of_fleets_, error.cwiseAbs().cwiseQuotient(of_the_fleet).maxCoeff());
    worst_ = std::max(
        worst_, error.cwiseAbs().cwiseQuotient(Eigen::VectorXd(cycle_.watch().error().health_sigma())).maxCoeff());
  }

  std::shared_ptr<const design::Design> design_;
  MonitorCycle cycle_;
  double worst_ = 0.0, worst_of_fleets_ = 0.0;  ///< of the published sigma; of that of an engine of the fleet
  int published_ = 0;
};

// chi-square with t degrees of freedom: mean t, variance 2 t, and one in a thousand beyond its quantile.
TEST_F(FleetWatchTest, TheDistanceOfTheFleetsEnginesIsAChiSquare) {
  const PreparedDesign prepared(design_);
  const FleetTable& table = *prepared.fleet->front();
  const Eigen::MatrixXd information = table.information;
  constexpr int engines = 400, samples = 1500;
  double sum = 0.0, squares = 0.0;
  test::Random random(71);
  for (int e = 0; e < engines; ++e) {
    test::Flight flight(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)),
                        static_cast<std::uint64_t>(e));
    MonitorCycle cycle(prepared, CycleOptions{});
    for (int k = 0; k < samples; ++k) cycle.process(flight.next());
    const Eigen::VectorXd q = cycle.watch().filter().tuners();
    const double d2 = q.dot(information * q);
    sum += d2;
    squares += d2 * d2;
  }
  const double t = table.tuners, mean = sum / engines, variance = squares / engines - mean * mean;
  EXPECT_NEAR(mean, t, 4.0 * std::sqrt(2.0 * t / engines));
  EXPECT_NEAR(variance, 2.0 * t, 4.0 * std::sqrt((8.0 * t * t + 48.0 * t) / engines));  // variance of a variance
  EXPECT_NEAR(table.ordinary, chi_square_quantile(t, 3.0902), 1e-3);
}

TEST_F(FleetWatchTest, AnEngineOfTheFleetIsNeverTouched) {
  test::Random random(72);
  for (int e = 0; e < 50; ++e) {
    MonitorCycle cycle(design_, CycleOptions{});
    test::Flight flight(design_->model, design_->model.health_sigma.cwiseProduct(random.normal_vector(10)),
                        static_cast<std::uint64_t>(1000 + e));
    for (int k = 0; k < 1000; ++k) {
      cycle.process(flight.next());
      ASSERT_TRUE(cycle.result().estimates);
    }
    EXPECT_EQ(count(cycle.events(), idl::EventKind::implausible, true), 0) << e;
    EXPECT_EQ(count(cycle.events(), idl::EventKind::unlikely_engine, true), 0) << e;
  }
}

TEST_F(FleetWatchTest, ADriftOfAllSensorsIsNamedAndThenWithheld) {
  test::Flight flight(design_->model, Eigen::VectorXd::Zero(10), 73);
  drift(flight, 20.0, 0.0, 0.0);
  drift(flight, 100.0, 0.5, 0.0);
  EXPECT_EQ(count(cycle_.events(), idl::EventKind::unlikely_engine, true), 1);
  EXPECT_GE(count(cycle_.events(), idl::EventKind::implausible, true), 1);
  EXPECT_FALSE(cycle_.result().estimates);
  EXPECT_TRUE(cycle_.result().flags & idl::estimate_flag::implausible);
  for (std::size_t i = 0; i < 7; ++i) EXPECT_TRUE(cycle_.result().reason[i] & idl::reject_reason::withheld);
  CycleState state;
  EXPECT_FALSE(cycle_.snapshot(state));  // nothing of this is worth a checkpoint
}

TEST_F(FleetWatchTest, WearFarBeyondTheFleetKeepsAnHonestSigmaUntilItIsWithheldAndComesBack) {
  test::Random random(74);
  test::Flight flight(design_->model, 0.3 * design_->model.health_sigma.cwiseProduct(random.normal_vector(10)), 74);
  drift(flight, 20.0, 0.0, 0.0);
  worst_ = 0.0;
  const int before = published_;
  drift(flight, 100.0, 0.0, 0.1);  // to ten sigmas of the prior, in all parameters
  EXPECT_GT(published_, before);
  EXPECT_LT(worst_, 4.0);
  EXPECT_GT(worst_of_fleets_, 8.0);  // what it would be without the growth
  EXPECT_TRUE(cycle_.result().flags & idl::estimate_flag::implausible);
  EXPECT_FALSE(cycle_.result().estimates);
  cycle_.clear_events();
  drift(flight, 100.0, 0.0, -0.1);
  EXPECT_TRUE(cycle_.result().estimates);
  EXPECT_FALSE(cycle_.result().flags & idl::estimate_flag::implausible);
  EXPECT_GE(count(cycle_.events(), idl::EventKind::unlikely_engine, false), 1);
}

TEST_F(FleetWatchTest, SigmaGrowsWithTheExcessInItsPartsOnly) {
  const PreparedDesign prepared(design_);
  estimation::ErrorPropagation error(prepared.tuner.errors->front());
  while (!error.settled()) error.step();
  const estimation::HealthVector at_1 = error.health_sigma();
  error.widen(4.0);
  const estimation::HealthVector at_4 = error.health_sigma();
  error.widen(16.0);
  const estimation::HealthVector at_16 = error.health_sigma();
  for (Eigen::Index i = 0; i < at_1.size(); ++i) {
    EXPECT_GT(at_4(i), at_1(i));
    EXPECT_LE(at_4(i), 4.0 * at_1(i));  // noise stays, the prior's part grows by 2, the nonlinearity's by 4
    // v(e) = n + e p + e^2 l: three values give the parts, none of which is negative
    const double v1 = at_1(i) * at_1(i), v4 = at_4(i) * at_4(i), v16 = at_16(i) * at_16(i);
    const double l = ((v16 - v4) / 12.0 - (v4 - v1) / 3.0) / 15.0, p = (v4 - v1) / 3.0 - 5.0 * l, n = v1 - p - l;
    EXPECT_GE(l, -1e-9 * v1);
    EXPECT_GE(p, -1e-9 * v1);
    EXPECT_GE(n, -1e-9 * v1);
  }
  error.widen(1.0);
  EXPECT_EQ(error.health_sigma(), at_1);
}

// In sigmas of what the fleet makes of the sensor. The innovation gate of a cold filter lets nearly five of them pass; a
// bias is one more unlikely thing beside the engine's own health.
TEST_F(FleetWatchTest, ABiasFromTheFirstSampleStandsOut) {
  const Eigen::VectorXd spread =
      Eigen::VectorXd(MonitorCycle(design_, CycleOptions{}).watch().error().innovation_variance()).cwiseSqrt();
  for (const double sigmas : {-6.0, -4.5, 4.5, 6.0}) {
    for (std::size_t i = 0; i < 7; ++i) {
      test::Flight flight(design_->model, Eigen::VectorXd::Zero(10), 75);
      MonitorCycle cycle(design_, CycleOptions{});
      for (int k = 0; k < 1500; ++k) {
        Sample s = flight.next();
        s.sensor[i] += sigmas * spread(as_index(i));
        cycle.process(s);
      }
      const bool named = !cycle.result().estimate.sensors[i];
      const bool doubted = (cycle.result().flags & idl::estimate_flag::implausible) != 0 || cycle.detection().doubted();
      EXPECT_TRUE(named || doubted) << i << ' ' << sigmas;
    }
  }
}

TEST_F(FleetWatchTest, ADistanceThatIsNoNumberIsNoEstimate) {
  FleetWatch watch(FleetOptions{}, design_->model, PreparedDesign(design_).fleet);
  EventList events;
  const Eigen::Index t = design_->full.V.rows();
  const estimation::HealthVector health = estimation::HealthVector::Zero(10);
  watch.check(estimation::TunerVector::Zero(t), health, -1, events);
  EXPECT_FALSE(watch.withheld());
  watch.check(estimation::TunerVector::Constant(t, 1e200), health, -1, events);  // its square is infinite
  EXPECT_TRUE(watch.withheld());
  EXPECT_EQ(watch.excess(), 1.0);  // sigmas stay numbers
  watch.check(estimation::TunerVector::Zero(t), health, -1, events);
  EXPECT_FALSE(watch.withheld());
}

}  // namespace
