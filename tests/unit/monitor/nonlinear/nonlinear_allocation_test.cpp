// SPDX-License-Identifier: Apache-2.0
// No nonlinear estimator allocates after its construction, with an answer of the engine or without.

#include <gtest/gtest.h>

#include "tests/unit/monitor/estimation/allocation_counter.h"
#include "tests/unit/monitor/nonlinear/cruise_engine.h"

namespace {

using namespace ehm;
using design::NonlinearKind;

class AllocationOfNonlinearEstimators : public testing::TestWithParam<NonlinearKind> {};

TEST_P(AllocationOfNonlinearEstimators, None) {
  monitor::EstimatorOptions options;
  options.particles = 10;
  options.particle_jacobian = "own";
  const auto estimator = design::make_nonlinear_estimator(GetParam(), nonlinear::test::as_filed(), options);
  nonlinear::test::CruiseEngine engine(1);
  engine.next();
  const estimation::Conditions now = engine.now;
  estimation::Conditions impossible = now;
  impossible.actuators(0) *= 50.0;
  estimation::EstimatorState state;
  const long before = ehm::test::allocation_count();
  for (int k = 0; k < 60; ++k) {
    const estimation::SensorMask available(k < 20 ? 127u : 125u);
    estimator->use(available);
    estimator->predict(now, k == 30 ? 20 : 1);
    estimator->innovate(engine.y, k % 10 == 9 ? impossible : now);
    estimator->update(k == 40 ? estimation::SensorMask{} : available, 1);
    estimator->widen(1.0 + 0.01 * k);
    if (k == 25) estimator->save(state);
    if (k == 45) estimator->next_flight(0.05);
  }
  EXPECT_TRUE(estimator->restore(state));
  estimator->reset();
  EXPECT_EQ(ehm::test::allocation_count(), before);
}

INSTANTIATE_TEST_SUITE_P(Kinds, AllocationOfNonlinearEstimators,
                         testing::Values(NonlinearKind::extended, NonlinearKind::iterated, NonlinearKind::clipped,
                                         NonlinearKind::unscented, NonlinearKind::particle,
                                         NonlinearKind::extended_particle, NonlinearKind::boxed_particle));

}  // namespace
