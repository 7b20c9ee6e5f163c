// SPDX-License-Identifier: Apache-2.0
// Sanity of the fitted maps: what a compressor or turbine does, whatever the numbers were fitted to.
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "engine_sim/engines/jt9d.h"

namespace ehm::engine_sim {
namespace {

struct NamedMap {
  const char* name;
  const CompressorMap& map;
  std::vector<double> speeds;  ///< speed lines of the table
};

std::vector<NamedMap> compressors() {
  return {{"fan", jt9d().fan.map, {0.5, 0.6, 0.7, 0.8, 0.85, 0.9, 0.95, 1.0, 1.05, 1.1, 1.15}},
          {"LPC", jt9d().lpc.map, {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.25}},
          {"HPC", jt9d().hpc.map, {0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9, 0.925, 0.95, 0.975, 1.0, 1.025, 1.05}}};
}

TEST(CompressorMap, EfficiencyHasOnePeakAlongEachSpeedLine) {
  for (const NamedMap& m : compressors()) {
    for (const double n : m.speeds) {
      int peaks = 0;
      double before = m.map.at(n, 1.0).efficiency, slope_before = 1.0;
      for (double r = 1.02; r <= 2.8; r += 0.02) {
        const double now = m.map.at(n, r).efficiency, slope = now - before;
        if (slope_before > 0.0 && slope <= 0.0) ++peaks;
        slope_before = slope;
        before = now;
      }
      EXPECT_LE(peaks, 1) << m.name << " n = " << n;
    }
  }
}

TEST(CompressorMap, FlowAndPressureRatioRiseWithSpeed) {
  for (const NamedMap& m : compressors()) {
    for (double r = 1.0; r <= 2.6; r += 0.1) {
      CompressorMapPoint<double> before = m.map.at(0.1, r);
      for (double n = 0.12; n <= 1.2; n += 0.02) {
        const CompressorMapPoint<double> now = m.map.at(n, r);
        EXPECT_GT(now.flow, before.flow) << m.name << " n = " << n << " R = " << r;
        EXPECT_GT(now.pressure_ratio, before.pressure_ratio) << m.name << " n = " << n << " R = " << r;
        before = now;
      }
    }
  }
}

TEST(CompressorMap, PressureRatioFallsFromPeakToChokeAndStaysAboveOne) {
  for (const NamedMap& m : compressors()) {
    for (const double n : m.speeds) {
      for (double r = 1.8; r <= 4.5; r += 0.1) {
        EXPECT_LT(m.map.at(n, r + 0.1).pressure_ratio, m.map.at(n, r).pressure_ratio + 1e-9) << m.name << n << " " << r;
        EXPECT_GE(m.map.at(n, r).pressure_ratio, 1.0);
        EXPECT_GT(m.map.at(n, r).efficiency, 0.04);
      }
    }
  }
}

TEST(CompressorMap, SurgeLineIsTheFirstRLine) {
  for (const NamedMap& m : compressors()) {
    for (const double n : m.speeds) {
      if (n < 0.5) continue;
      const CompressorMapPoint<double> surge = m.map.at(n, 1.0);
      EXPECT_NEAR(m.map.surge_pressure_ratio(surge.flow), surge.pressure_ratio, 0.01 * surge.pressure_ratio)
          << m.name << " n = " << n;
    }
  }
}

TEST(TurbineMap, FlowRisesWithExpansionRatioUntilItChokes) {
  for (const TurbineMap* map : {&jt9d().hpt.map, &jt9d().lpt.map}) {
    for (double n = 60.0; n <= 110.0; n += 5.0) {
      EXPECT_LT(map->at(n, 1.01).flow, 0.3 * map->at(n, 3.0).flow);  // no pressure difference, hardly any flow
      for (double p = 1.1; p < 7.8; p += 0.1) {
        EXPECT_GT(map->at(n, p + 0.1).flow, (1.0 - 2e-4) * map->at(n, p).flow) << n << " " << p;
      }
    }
  }
}

TEST(CompressorMap, RefusesTablesThatDoNotFitTheirBreakPoints) {
  const std::vector<double> breaks{0.0, 1.0}, right(16, 1.0), wrong(15, 1.0), surge(4, 1.0);
  EXPECT_NO_THROW(CompressorMap({1, 2, breaks, breaks, right, right, right, breaks, surge, 3.0}));
  EXPECT_THROW(CompressorMap({1, 2, breaks, breaks, right, wrong, right, breaks, surge, 3.0}), std::invalid_argument);
  EXPECT_THROW(TurbineMap({3, breaks, breaks, right, wrong}), std::invalid_argument);
}

}  // namespace
}  // namespace ehm::engine_sim
