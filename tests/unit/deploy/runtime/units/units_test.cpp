// SPDX-License-Identifier: Apache-2.0
// The table of units against one of our own, whose numbers are worked out here from the definitions: of the pound, the
// inch, standard gravity and the scales of temperature (SI brochure, NIST SP 811).

#include "deploy/runtime/units/units.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

using namespace ehm::units;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

struct Known {
  const char* from;
  double value;
  const char* to;
  double expected;
};

void PrintTo(const Known& known, std::ostream* out) {
  *out << known.value << ' ' << known.from << " in " << known.to;
}

class Values : public testing::TestWithParam<Known> {};

TEST_P(Values, GoThereAndBack) {
  const Known& known = GetParam();
  const auto there = conversion(known.from, known.to), back = conversion(known.to, known.from);
  ASSERT_TRUE(there && back);
  const double scale = std::max(1.0, std::abs(known.expected));
  EXPECT_NEAR((*there)(known.value), known.expected, 1e-12 * scale);
  EXPECT_NEAR((*back)((*there)(known.value)), known.value, 1e-12 * std::max(1.0, std::abs(known.value)) * 1e3);
}

constexpr double lb = 0.45359237, in = 0.0254, g = 9.80665;  // exact by definition

INSTANTIATE_TEST_SUITE_P(Temperatures, Values,
                         testing::Values(Known{"degC", 0.0, "K", 273.15}, Known{"degC", 121.4624089, "K", 394.6124089},
                                         Known{"degF", 32.0, "K", 273.15}, Known{"degF", 212.0, "degC", 100.0},
                                         Known{"degF", -40.0, "degC", -40.0}, Known{"degR", 491.67, "K", 273.15},
                                         Known{"degF", 0.0, "degR", 459.67}, Known{"K", 0.0, "degC", -273.15},
                                         Known{"degR", 710.302336, "K", 710.302336 * 5.0 / 9.0}));

INSTANTIATE_TEST_SUITE_P(Pressures, Values,
                         testing::Values(Known{"psi", 1.0, "Pa", lb* g / (in * in)},
                                         Known{"psia", 14.695948775513, "atm", 1.0}, Known{"kPa", 3.0, "Pa", 3000.0},
                                         Known{"MPa", 1.0, "bar", 10.0}, Known{"bar", 1.0, "Pa", 1e5},
                                         Known{"mbar", 1013.25, "hPa", 1013.25}, Known{"atm", 1.0, "Pa", 101325.0},
                                         Known{"inHg", 1.0, "Pa", 25.4 * 13.5951 * g},
                                         Known{"mmHg", 1.0, "Pa", 13.5951 * g}, Known{"torr", 760.0, "atm", 1.0},
                                         Known{"inH2O", 1.0, "Pa", 25.4 * g}, Known{"psf", 144.0, "psi", 1.0},
                                         Known{"kgf/cm2", 1.0, "Pa", g / 1e-4},
                                         Known{"psig", 1.0, "kPag", 1e-3 * lb* g / (in * in)}));

INSTANTIATE_TEST_SUITE_P(Flows, Values,
                         testing::Values(Known{"lbm/s", 1.0, "kg/s", lb}, Known{"pph", 3600.0, "lbm/s", 1.0},
                                         Known{"lbm/h", 3600.0, "kg/s", lb}, Known{"kg/h", 3600.0, "kg/s", 1.0},
                                         Known{"kg/min", 60.0, "kg/s", 1.0},
                                         Known{"g/s", 823.8939129, "kg/s", 0.8238939129},
                                         Known{"lbm/min", 60.0, "kg/s", lb}, Known{"t/h", 3.6, "kg/s", 1.0}));

INSTANTIATE_TEST_SUITE_P(Others, Values,
                         testing::Values(Known{"rpm", 60.0, "rev/s", 1.0}, Known{"rpm", 60.0, "rad/s", 2.0 * M_PI},
                                         Known{"Hz", 1.0, "rpm", 60.0}, Known{"krpm", 7.3, "rpm", 7300.0},
                                         Known{"percent", 12.5, "fraction", 0.125}, Known{"fraction", 0.5, "%", 50.0},
                                         Known{"ft", 35000.0, "m", 35000.0 * 12.0 * in},
                                         Known{"kft", 35.0, "m", 35000.0 * 12.0 * in}, Known{"km", 1.0, "m", 1000.0},
                                         Known{"kt", 1.0, "m/s", 1852.0 / 3600.0}, Known{"ft/s", 1.0, "m/s", 12.0 * in},
                                         Known{"km/h", 3.6, "m/s", 1.0}, Known{"deg", 180.0, "rad", M_PI},
                                         Known{"lbf", 1.0, "N", lb* g}, Known{"kN", 2.0, "N", 2000.0},
                                         Known{"kgf", 1.0, "N", g}, Known{"hp", 1.0, "W", 550.0 * 12.0 * in* lb* g},
                                         Known{"lbf ft", 1.0, "N m", 12.0 * in* lb* g}));

TEST(Units, OfOneSpellingAreLeftAloneToTheBit) {
  for (const auto& [a, b] : {std::pair{"K", "K"},
                             {"Pa", "[Pa]"},
                             {"degC", "°C"},
                             {"rpm", "1/min"},
                             {"-", "fraction"},
                             {"furlong", "furlong"},
                             {"", "K"},
                             {"K", ""}}) {
    const auto found = conversion(a, b);
    ASSERT_TRUE(found) << a << " " << b;
    EXPECT_FALSE(found->changes()) << a << " " << b;
  }
}

TEST(Units, AreKnownByTheirSpellings) {
  const std::pair<const char*, std::vector<const char*>> spellings[]{
      {"degC",
       {"C", "°C",
        "\xB0"
        "C",
        "deg C", "deg_C", "DEGC", "Celsius", "degrees Celsius", "[°C]", "degree C"}},
      {"degF", {"F", "°F", "deg F", "Fahrenheit"}},
      {"degR", {"R", "°R", "Rankine", "deg R"}},
      {"K", {"k", "Kelvin", "[K]", "degK"}},
      {"psi", {"psia", "PSIA", "psi(a)", "psi (a)", "lbf/in^2", "lb/in2"}},
      {"psig", {"PSIG", "psi(g)"}},
      {"kPa", {"KPA", "kPa(a)", "kpa"}},
      {"kg/s", {"kg s^-1", "kg s-1", "kg·s⁻¹", "kg*s^-1", "KG/S", "kg/sec", "kg.s-1"}},
      {"lbm/s", {"lb/s", "lbm s^-1", "LBM/S", "pps", "lb/sec"}},
      {"lbm/h", {"pph", "PPH", "lb/hr", "lbm/hr"}},
      {"kg/h", {"kg/hr", "KG/H"}},
      {"rpm", {"RPM", "1/min", "min^-1", "min⁻¹", "rev/min", "r/min"}},
      {"rev/s", {"Hz", "rps", "1/s"}},
      {"percent", {"%", "pct", "Percent"}},
      {"fraction", {"-", "[-]", "1", "Mach"}},
      {"deg", {"degree", "degrees", "°"}},
      {"ft", {"feet", "FT"}}};
  for (const auto& [unit, others] : spellings)
    for (const char* other : others) {
      const auto same = conversion(other, unit);
      ASSERT_TRUE(same) << other;
      EXPECT_FALSE(same->changes()) << other;
    }
}

TEST(Units, WhoseCapitalsMatterAreNotMistaken) {
  EXPECT_TRUE(conversion("MPa", "Pa"));
  for (const char* doubtful : {"mPa", "MBAR", "Mbar", "mn"}) EXPECT_FALSE(conversion(doubtful, "Pa")) << doubtful;
}

TEST(Units, OfDifferentQuantitiesAreRefusedWithBothNamed) {
  EXPECT_FALSE(conversion("K", "Pa"));
  EXPECT_FALSE(conversion("rpm", "percent"));
  EXPECT_FALSE(conversion("lb", "N"));
  EXPECT_FALSE(conversion("furlong", "m"));
  EXPECT_EQ(why_not("K", "Pa"), "'K' is a temperature, 'Pa' is a pressure");
  EXPECT_EQ(why_not("furlong", "m"), "'furlong' is not known, 'm' is a length");
}

TEST(Units, OfGaugePressureNeedTheAmbientOne) {
  EXPECT_FALSE(conversion("psig", "Pa"));
  EXPECT_FALSE(conversion("kPa", "barg"));
  EXPECT_THAT(why_not("psig", "Pa"), HasSubstr("a gauge pressure needs the ambient one added before"));
  EXPECT_THAT(why_not("psig", "K"), HasSubstr("gauge"));
}

TEST(Units, OfDifferencesHaveNoOffset) {
  const Conversion sigma = conversion("degF", "K")->of_differences();
  EXPECT_DOUBLE_EQ(sigma(9.0), 5.0);
  EXPECT_DOUBLE_EQ(conversion("degC", "K")->of_differences()(2.5), 2.5);
}

TEST(Units, HaveRelatives) {
  const auto pressures = relatives("kPa(a)");
  EXPECT_THAT(pressures, Contains("psi"));
  EXPECT_THAT(pressures, Contains("Pa"));
  EXPECT_THAT(pressures, Not(Contains("kPa")));
  EXPECT_THAT(pressures, Not(Contains("psig")));
  EXPECT_TRUE(relatives("furlong").empty());
}

}  // namespace
