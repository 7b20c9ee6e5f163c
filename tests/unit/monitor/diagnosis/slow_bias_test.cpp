// SPDX-License-Identifier: Apache-2.0
// Slow bias: raised for a bias that the fleet's wear does not explain, and only where a sensor can be told at all.

#include "monitor/diagnosis/slow_bias.h"

#include <gtest/gtest.h>

#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "monitor/design/detectability.h"
#include "monitor/estimation/steady_gain.h"
#include "tests/unit/monitor/cycle/flight.h"

namespace {

using namespace ehm;
using namespace ehm::monitor;

/// Raised events of an engine with health `h` whose tuners follow a bias of `sigmas` of one sensor.
std::vector<Event> events_of(const design::Design& design, const Eigen::VectorXd& h, int sensor, double sigmas) {
  const auto model = linear_model::scaled(design.model, design.scaling);
  const Eigen::MatrixXd H = estimation::steady_gain(model).H;
  Eigen::VectorXd ys = H * h;
  ys(sensor) += sigmas * model.sensor_noise_sigma(sensor);
  const Eigen::VectorXd q = (H * design.full.W).completeOrthogonalDecomposition().solve(ys);
  SlowBias watch(FaultOptions{}, slow_bias_table(design));
  EventList events;
  std::vector<Event> raised;
  for (int k = 0; k < 1000; ++k) watch.check(q, events);
  for (const Event& e : events)
    if (e.raised) raised.push_back(e);
  return raised;
}

TEST(SlowBias, FollowsItsDetectability) {
  const auto design = test::made_up_design();
  const Eigen::VectorXd detectability = design::slow_bias_detectability(design->model, design->scaling, design->full);
  const SlowBias watch(FaultOptions{}, slow_bias_table(*design));
  for (int i = 0; i < 7; ++i) {
    EXPECT_EQ(watch.watches(i), detectability(i) > 5.0) << i;
    // A bias ten threshold sizes large is seen where the sensor is watched, and nowhere else.
    const double sigmas = 5.0 * 10.0 / detectability(i);
    const auto raised = events_of(*design, Eigen::VectorXd::Zero(10), i, sigmas);
    EXPECT_EQ(raised.size(), watch.watches(i) ? 1u : 0u) << i << ' ' << detectability(i);
    if (!raised.empty()) {
      EXPECT_EQ(raised[0].channel, static_cast<std::uint32_t>(i));
      EXPECT_GT(raised[0].value, raised[0].threshold);
    }
  }
}

TEST(SlowBias, WearOfTheFleetIsNoBias) {
  const auto design = test::made_up_design();
  test::Random random(9);
  for (int engine = 0; engine < 2000; ++engine) {
    const Eigen::VectorXd h = 2.0 * random.normal_vector(10);  // percent, the fleet's spread
    EXPECT_TRUE(events_of(*design, h, 0, 0.0).empty()) << engine;
  }
}

}  // namespace
