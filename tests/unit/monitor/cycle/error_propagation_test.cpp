#include "monitor/estimation/error_propagation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "monitor/design/make_error_model.h"
#include "monitor/design/make_filter.h"
#include "tests/unit/monitor/cycle/flight.h"

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

// Over a fleet of engines the squared errors at a given sample average to the published variance of that sample.
TEST(ErrorPropagation, AgreesWithAFleetAtEverySample) {
  const auto design = test::made_up_design();
  constexpr int engines = 800;
  constexpr std::array<int, 4> samples{1, 20, 80, 300};
  std::array<Eigen::ArrayXd, samples.size()> ratio;
  ratio.fill(Eigen::ArrayXd::Zero(10));
  test::Random random(5);
  for (int engine = 0; engine < engines; ++engine) {
    test::Flight flight(design->model, design->model.health_sigma.cwiseProduct(random.normal_vector(10)),
                        static_cast<std::uint64_t>(engine));
    monitor::MonitorCycle cycle(design, monitor::CycleOptions{});
    for (std::size_t checkpoint = 0, k = 0; checkpoint < samples.size(); ++checkpoint) {
      for (; k < static_cast<std::size_t>(samples[checkpoint]); ++k) cycle.process(flight.next());
      ratio[checkpoint] +=
          ((cycle.filter().health() - flight.health()).array() / cycle.error().health_sigma().array()).square();
    }
  }
  // A chi-square with 800 degrees of freedom over 800 has standard deviation sqrt(2/800) = 0.05.
  for (const auto& r : ratio)
    for (Eigen::Index i = 0; i < 10; ++i) EXPECT_NEAR(r(i) / engines, 1.0, 4.0 * 0.05);
}

}  // namespace
