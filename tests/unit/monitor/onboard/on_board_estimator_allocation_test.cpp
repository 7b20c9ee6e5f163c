// SPDX-License-Identifier: Apache-2.0
// The on-board estimator allocates nothing after its construction: from its start over a taxi and a take-off.

#include <gtest/gtest.h>

#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/monitor/onboard/on_board_flight.h"

namespace ehm::onboard {
namespace {

TEST(AllocationOfTheOnBoardEstimator, NoneWithAnAnswerOrWithout) {
  test::OnBoardFlight flight({.seed = 3});
  std::vector<std::pair<estimation::SensorVector, estimation::Conditions>> samples;
  while (flight.time_s() < 440.0) {
    flight.next();
    if (flight.time_s() > 395.0) samples.emplace_back(flight.measured(), flight.now);
  }
  OnBoardEstimator& estimator = flight.estimator;
  const long before = ehm::test::allocation_count();
  estimator.reset();
  for (std::size_t k = 0; k < samples.size(); ++k) {
    estimation::Conditions now = samples[k].second;
    if (k % 40 == 39) now.actuators(0) *= 50.0;
    estimator.use(flight.fused);
    estimator.predict(now, k % 30 == 29 ? 20 : 1);
    estimator.innovate(samples[k].first, now);
    estimator.update(flight.fused, 1);
    estimator.widen(1.0 + 0.001 * static_cast<double>(k));
    if (k % 50 == 49) estimator.correct_health(estimator.health_covariance().diagonal());
  }
  const estimation::Learned learned = estimator.learned();
  estimator.next_flight(0.05);
  EXPECT_TRUE(estimator.begin_with(learned, 0.05));
  EXPECT_EQ(ehm::test::allocation_count(), before);
  EXPECT_GT(samples.size(), 400u);
}

}  // namespace
}  // namespace ehm::onboard
