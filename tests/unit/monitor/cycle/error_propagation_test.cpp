// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/error_propagation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/design/make_error_model.h"
#include "monitor/design/make_filter.h"
#include "tests/unit/monitor/cycle/flight.h"
#include "tuner_design/design/design_tuner.h"

namespace {

using namespace ehm;

TEST(ErrorPropagation, StartsAtThePriorAndEndsAtTheSteadyTotalError) {
  const auto design = test::made_up_design();
  const auto model = design::make_error_model(*design, design->full);
  const auto filter = design::make_filter(*design);
  estimation::ErrorPropagation error(model);
  EXPECT_TRUE(error.health_sigma().isApprox(design->model.health_sigma, 1e-12));
  while (!error.settled()) error.step();
  EXPECT_TRUE(error.health_sigma().isApprox(filter.health_sigma_total(), 1e-4));
  EXPECT_TRUE(error.auxiliary_sigma().isApprox(filter.auxiliary_sigma_total(), 1e-4));
}

TEST(ErrorPropagation, SwitchingToAnotherSetEndsAtItsSteadyTotalError) {
  const auto design = test::made_up_design();
  const auto full = design::make_error_model(*design, design->full);
  const auto without = design::make_error_model(*design, *design->missing[3]);
  auto filter = design::make_filter(*design);
  estimation::ErrorPropagation error(full);
  while (!error.settled()) error.step();
  filter.switch_sensor_set(estimation::SensorSet::without(3));
  error.switch_to(without, filter.gain().from_full);
  EXPECT_FALSE(error.settled());
  while (!error.settled()) error.step();
  EXPECT_TRUE(error.health_sigma().isApprox(filter.health_sigma_total(), 1e-4));
}

/// Over a fleet of engines the squared errors at a given sample average to the published variance of that sample.
void expect_agreement_with_a_fleet(const std::shared_ptr<const design::Design>& design, bool moving) {
  constexpr int engines = 800;
  constexpr std::array<int, 4> samples{1, 20, 80, 300};
  std::array<Eigen::ArrayXd, samples.size()> ratio;
  ratio.fill(Eigen::ArrayXd::Zero(10));
  test::Random random(5);
  for (int engine = 0; engine < engines; ++engine) {
    test::Flight flight(design->model, design->model.health_sigma.cwiseProduct(random.normal_vector(10)),
                        static_cast<std::uint64_t>(engine));
    if (moving) flight.start_moving();
    monitor::MonitorCycle cycle(design, monitor::CycleOptions{});
    for (std::size_t checkpoint = 0, k = 0; checkpoint < samples.size(); ++checkpoint) {
      for (; k < as_size(samples[checkpoint]); ++k) cycle.process(flight.next());
      ratio[checkpoint] +=
          ((cycle.watch().filter().health() - flight.health()).array() / cycle.watch().error().health_sigma().array())
              .square();
    }
  }
  // A chi-square with 800 degrees of freedom over 800 has standard deviation sqrt(2/800) = 0.05.
  for (const auto& r : ratio)
    for (Eigen::Index i = 0; i < 10; ++i) EXPECT_NEAR(r(i) / engines, 1.0, 4.0 * 0.05);
}

std::shared_ptr<const design::Design> design_with_process_noise(double factor) {
  linear_model::LinearModel model = test::made_up_model(7, 10);
  model.process_noise *= factor;
  return std::make_shared<const design::Design>(tuner_design::design_tuner(model, {}));
}

TEST(ErrorPropagation, AgreesWithAFleetAtEverySample) {
  expect_agreement_with_a_fleet(design_with_process_noise(0.0), false);
}

TEST(ErrorPropagation, AgreesWithAFleetThatProcessNoiseMoves) {
  expect_agreement_with_a_fleet(design_with_process_noise(900.0), true);
}

TEST(ErrorPropagation, ProcessNoiseIsInTheInnovationsToo) {
  // At a cold start the variance of the first innovation is that of the fleet's sensors, C (motion) C^T among them.
  const auto still = design_with_process_noise(0.0), moving = design_with_process_noise(900.0);
  const auto still_model = design::make_error_model(*still, still->full);
  const auto moving_model = design::make_error_model(*moving, moving->full);
  const linear_model::LinearModel& model = moving->model;
  const Eigen::VectorXd motion =
      (model.C * linear_model::stationary_covariance(model.A, model.process_noise) * model.C.transpose()).diagonal();
  const Eigen::VectorXd more = estimation::ErrorPropagation(moving_model).innovation_variance() -
                               estimation::ErrorPropagation(still_model).innovation_variance();
  EXPECT_TRUE(more.isApprox(motion, 1e-9));
}

TEST(ErrorPropagation, TheDetectorsDivideByTheVarianceOfInnovationsUnderProcessNoise) {
  // Without Q in it the sensors next to the moving states would seem to be several times too loud.
  const auto design = design_with_process_noise(900.0);
  const monitor::PreparedDesign prepared(design);
  const Eigen::VectorXd sigma = prepared.faults->full.innovation_sigma.cwiseProduct(prepared.faults->sensor_scale);
  test::Flight flight(design->model, Eigen::VectorXd::Zero(10), 17);
  flight.start_moving();
  monitor::MonitorCycle cycle(prepared, monitor::CycleOptions{});
  while (!cycle.watch().error().settled()) cycle.process(flight.next());
  constexpr int samples = 40000;
  Eigen::VectorXd square = Eigen::VectorXd::Zero(7);
  for (int k = 0; k < samples; ++k) {
    cycle.process(flight.next());
    square += cycle.result().innovation.cwiseQuotient(sigma).cwiseAbs2() / samples;
  }
  // Nearly white: the mean square scatters with sqrt(2 / 40000) = 0.007.
  for (Eigen::Index i = 0; i < 7; ++i) EXPECT_NEAR(square(i), 1.0, 0.035) << i;
}

}  // namespace
