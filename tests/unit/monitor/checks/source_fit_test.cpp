// SPDX-License-Identifier: Apache-2.0
// How a source's channels fit the design's: by name, place and unit, and what becomes of its values.

#include "monitor/checks/source_fit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace ehm::monitor;

const std::vector<ehm::linear_model::Channel> design{{"T24", "K", 390.0}, {"P24", "Pa", 148e3}, {"T30", "K", 660.0}};

TEST(SourceFit, NamesPlacesAndUnits) {
  struct Case {
    ChannelWords said;
    std::size_t i;
    Misfit expected;
  };
  for (const Case& c :
       {Case{{"T24", "K"}, 0, Misfit::none}, Case{{"T24", "degC"}, 0, Misfit::none}, Case{{"", ""}, 0, Misfit::none},
        Case{{"T24", ""}, 0, Misfit::none}, Case{{"T25", "K"}, 0, Misfit::name}, Case{{"T25", "degF"}, 0, Misfit::name},
        Case{{"T30", "K"}, 0, Misfit::place}, Case{{"T24", "psi"}, 0, Misfit::unit},
        Case{{"P24", "psig"}, 1, Misfit::unit}, Case{{"P24", "furlong"}, 1, Misfit::unit}}) {
    const ChannelFit fit = fit_channel(c.said, design, c.i);
    EXPECT_EQ(fit.misfit, c.expected) << c.said.name << " " << c.said.unit;
    EXPECT_EQ(fit.used(), c.expected == Misfit::none || c.expected == Misfit::name);
  }
}

TEST(SourceFit, ConvertsWhatFitsAndTakesOutWhatDoesNot) {
  SourceFit fit;
  fit.sensors[0] = fit_channel({"T24", "degC"}, design, 0);
  fit.sensors[1] = fit_channel({"P24", "K"}, design, 1);
  fit.actuators[0] = fit_channel({"fuel", "lbm/h"}, {{"fuel", "kg/s", 0.8}}, 0);
  fit.actuators[1] = fit_channel({"VSV", "percent"}, {{"VSV", "deg", 0.0}}, 0);
  Sample sample;
  sample.sensor_count = 3;
  sample.actuator_count = 2;
  sample.sensor_valid = 0b111;
  sample.sensor = {121.4624089, 394.6, 660.25};
  sample.actuator = {3600.0, 5.0};
  fit.apply(sample);
  EXPECT_DOUBLE_EQ(sample.sensor[0], 394.6124089);  // 0 degC is 273.15 K
  EXPECT_TRUE(std::isnan(sample.sensor[1]));
  EXPECT_EQ(sample.sensor[2], 660.25);
  EXPECT_EQ(sample.sensor_valid, 0b101u);
  EXPECT_DOUBLE_EQ(sample.actuator[0], 0.45359237);  // a pound a second
  EXPECT_TRUE(std::isnan(sample.actuator[1]));       // which makes the sample malformed
}

TEST(SourceFit, OfASourceThatSaysNothingChangesNoBit) {
  Sample sample;
  sample.sensor_count = sample.actuator_count = 2;
  sample.sensor_valid = 0b01;
  sample.sensor = {0.1, -0.0};
  sample.actuator = {-0.0, 1e300};
  const Sample before = sample;
  SourceFit{}.apply(sample);
  EXPECT_EQ(sample.sensor, before.sensor);
  EXPECT_TRUE(std::signbit(sample.sensor[1]));
  EXPECT_TRUE(std::signbit(sample.actuator[0]));
  EXPECT_EQ(sample.sensor_valid, before.sensor_valid);
}

}  // namespace
