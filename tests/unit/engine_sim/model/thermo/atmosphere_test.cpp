// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/model/thermo/atmosphere.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace ehm::engine_sim {
namespace {

// ISO 2533 standard atmosphere tables, geopotential altitude: 0, 11 and 13 km.
TEST(Atmosphere, AgreesWithTheStandardTables) {
  EXPECT_NEAR(atmosphere(0.0, 0.0).t_k, 288.15, 1e-9);
  EXPECT_NEAR(atmosphere(0.0, 0.0).p_pa, 101325.0, 1e-6);
  EXPECT_NEAR(atmosphere(11000.0, 0.0).t_k, 216.65, 1e-9);
  EXPECT_NEAR(atmosphere(11000.0, 0.0).p_pa, 22632.0, 1.0);
  EXPECT_NEAR(atmosphere(13000.0, 0.0).t_k, 216.65, 1e-9);
  EXPECT_NEAR(atmosphere(13000.0, 0.0).p_pa, 16510.4, 1.0);
}

TEST(Atmosphere, OffsetMovesTemperatureOnly) {
  EXPECT_NEAR(atmosphere(5000.0, 15.0).t_k, atmosphere(5000.0, 0.0).t_k + 15.0, 1e-9);
  EXPECT_EQ(atmosphere(5000.0, 15.0).p_pa, atmosphere(5000.0, 0.0).p_pa);
}

TEST(Atmosphere, RefusesWhatIsOutOfRange) {
  EXPECT_THROW(atmosphere(25000.0, 0.0), std::out_of_range);
  EXPECT_THROW(atmosphere(std::numeric_limits<double>::quiet_NaN(), 0.0), std::out_of_range);
  EXPECT_THROW(atmosphere(0.0, 100.0), std::out_of_range);
}

}  // namespace
}  // namespace ehm::engine_sim
