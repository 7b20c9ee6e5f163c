// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/parts/nozzle.h"

#include <gtest/gtest.h>

namespace ehm::engine_sim {
namespace {

const NozzleData one_square_metre{1.0, 1.0};

// Cold air, gamma = 1.4: critical pressure ratio 1.8929, choked flow 0.040418 Pt A/sqrt(Tt) kg/s (any gas dynamics
// table).
TEST(Nozzle, ChokedFlowOfColdAirIsTheTextbookValue) {
  const auto in = make_stream(100.0, 250e3, 260.0, 0.0);
  const auto out = exhaust(one_square_metre, in, 100e3);
  EXPECT_TRUE(out.choked);
  EXPECT_NEAR(out.flow_capacity_kg_s, 0.040418 * 250e3 / std::sqrt(260.0), 1e-3 * out.flow_capacity_kg_s);
}

// M = 0.5, gamma = 1.4: Pt/p = 1.18621, W sqrt(Tt)/(Pt A) = 0.0301656 (the choked value over A/A* = 1.33984).
TEST(Nozzle, UnchokedFlowOfColdAirIsTheTextbookValue) {
  const auto in = make_stream(100.0, 118621.0, 260.0, 0.0);
  const auto out = exhaust(one_square_metre, in, 100e3);
  EXPECT_FALSE(out.choked);
  EXPECT_NEAR(out.flow_capacity_kg_s, 0.0301656 * 118621.0 / std::sqrt(260.0), 1e-3 * out.flow_capacity_kg_s);
}

TEST(Nozzle, ThrustIsMomentumPlusPressureForce) {
  // unchoked: the jet leaves at ambient pressure, F = W Cv V with V^2 = 2 cp (Tt - T); M = 0.5 at 260 K: T = 247.619 K
  const auto in = make_stream(100.0, 118621.0, 260.0, 0.0);
  const double v = 0.5 * std::sqrt(1.4 * 287.05 * 247.619);
  EXPECT_NEAR(exhaust({1.0, 0.98}, in, 100e3).gross_thrust_n, 100.0 * 0.98 * v, 2e-3 * 100.0 * v);
  // choked: pressure force (p* - p0) A on top, p* = Pt/1.8929
  const auto high = make_stream(100.0, 250e3, 260.0, 0.0);
  const double v_sonic = std::sqrt(1.4 * 287.05 * 260.0 / 1.2);
  EXPECT_NEAR(exhaust(one_square_metre, high, 100e3).gross_thrust_n, 100.0 * v_sonic + (250e3 / 1.8929 - 100e3), 100.0);
}

TEST(Nozzle, FlowAndSlopeAreContinuousWhereItChokes) {
  const auto flow_at = [](double pt) {
    const auto in = make_stream<Dual<1>>(100.0, Dual<1>::variable(pt, 0), 1000.0, 0.02);
    return exhaust(one_square_metre, in, 100e3);
  };
  double low = 150e3, high = 250e3;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (flow_at(middle).choked ? high : low) = middle;
  }
  const auto below = flow_at(low), above = flow_at(high);
  EXPECT_NEAR(below.flow_capacity_kg_s.v, above.flow_capacity_kg_s.v, 1e-9 * above.flow_capacity_kg_s.v);
  EXPECT_NEAR(below.flow_capacity_kg_s.d[0], above.flow_capacity_kg_s.d[0], 1e-6 * above.flow_capacity_kg_s.d[0]);
}

TEST(Nozzle, FlowFallsThroughZeroWithoutARoot) {
  const auto at = [](double ratio) {
    return exhaust(one_square_metre, make_stream(100.0, ratio * 100e3, 300.0, 0.0), 100e3).flow_capacity_kg_s;
  };
  EXPECT_GT(at(1.01), at(1.0002));
  EXPECT_GT(at(1.0002), at(0.99));
  EXPECT_LT(at(0.9), 0.0);
}

}  // namespace
}  // namespace ehm::engine_sim
