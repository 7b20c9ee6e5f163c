// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/limit_watch.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace ehm;
using namespace ehm::monitor;

linear_model::LinearModel model() {
  linear_model::LinearModel m;
  m.health = {{"hpc_efficiency", "fraction", 0.0}};
  m.auxiliary = {{"T40", "K", 1300.0}};
  return m;
}

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(LimitWatch, RaisesOutsideAndClearsInsideByTheHysteresis) {
  LimitWatch watch({{"T40", -infinity, 1380.0, 5.0}}, model());
  EventList events;
  const estimation::HealthVector health = estimation::HealthVector::Zero(1);
  const auto at = [&](double t40_k) {
    watch.check(health, estimation::AuxiliaryVector::Constant(1, t40_k), events);
    return events.size();
  };
  EXPECT_EQ(at(1379.0), 0u);
  EXPECT_EQ(at(1381.0), 1u);
  EXPECT_TRUE(events.begin()->raised);
  EXPECT_DOUBLE_EQ(events.begin()->threshold, 1380.0);
  EXPECT_EQ(at(1376.0), 1u);  // inside, but not by 5 K
  EXPECT_EQ(at(1374.0), 2u);
  EXPECT_FALSE((events.begin() + 1)->raised);
}

TEST(LimitWatch, WatchesHealthFromBelow) {
  LimitWatch watch({{"hpc_efficiency", -0.025, infinity, 0.005}}, model());
  EventList events;
  const estimation::AuxiliaryVector auxiliary = estimation::AuxiliaryVector::Constant(1, 1300.0);
  watch.check(estimation::HealthVector::Constant(1, -0.03), auxiliary, events);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events.begin()->kind, idl::EventKind::health_limit);
  EXPECT_DOUBLE_EQ(events.begin()->value, -0.03);
}

TEST(LimitWatch, RefusesAQuantityThatIsNotEstimated) {
  try {
    LimitWatch watch({{"T41", 0.0, 1.0, 0.0}}, model());
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_STREQ(e.what(), "limit.quantity is 'T41', which the design does not estimate; it has hpc_efficiency T40");
  }
}

}  // namespace
