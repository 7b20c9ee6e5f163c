// SPDX-License-Identifier: Apache-2.0
// What is noted of a flight at a design's point, between a landing that is made up and the next.

#include "monitor/flight/flight_log.h"

#include <gtest/gtest.h>

#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

class FlightLogTest : public testing::Test {
 protected:
  FlightLogTest()
      : design_(test::made_up_design()),
        cycle_(design_, CycleOptions{}),
        flight_(design_->model, Eigen::VectorXd::Zero(10), 3) {}

  /// So many samples; whether a flight ended in them.
  bool fly(int samples, bool on_ground) {
    bool landed = false;
    for (int i = 0; i < samples; ++i) {
      Sample sample = flight_.next();
      sample.flight = {10000.0, on_ground ? 0.0 : 0.8, 0.0};
      EXPECT_TRUE(cycle_.process(sample));
      landed |= log_.follow(cycle_, fan_);
      cycle_.clear_events();
    }
    return landed;
  }

  std::shared_ptr<const design::Design> design_;
  MonitorCycle cycle_;
  test::Flight flight_;
  FanSpeed fan_ = fan_speed_of(test::made_up_design()->model);
  FlightLog log_;
};

TEST_F(FlightLogTest, SumsUpWhatWasEstimatedAndMeasured) {
  EXPECT_FALSE(fly(2000, false));
  EXPECT_EQ(log_.flight(), 1u);
  const estimation::HealthVector health = cycle_.result().estimate.health;
  EXPECT_TRUE(fly(200, true));
  const FlightTotals& f = log_.finished();
  EXPECT_EQ(f.flight, 1u);
  EXPECT_GE(f.samples, 2000u);
  EXPECT_GE(f.estimated, 2000u);
  EXPECT_LT(f.samples, 2000u + 100u) << "a second of roll-out";
  EXPECT_GT(f.landing_ns, f.start_ns);
  ASSERT_EQ(f.health.size(), health.size());
  ASSERT_EQ(f.sensor_greatest.size(), static_cast<Eigen::Index>(design_->model.sensors.size()));
  for (Eigen::Index i = 0; i < f.sensor_greatest.size(); ++i)
    EXPECT_NEAR(f.sensor_greatest(i), design_->model.sensors[static_cast<std::size_t>(i)].trim,
                8.0 * design_->model.sensor_noise_sigma(i));
  for (Eigen::Index i = 0; i < f.auxiliary_least.size(); ++i) EXPECT_LT(f.auxiliary_least(i), f.auxiliary_greatest(i));
  EXPECT_FALSE(fly(100, false));
  EXPECT_EQ(log_.flight(), 2u);
}

}  // namespace
