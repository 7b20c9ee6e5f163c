// SPDX-License-Identifier: Apache-2.0
#pragma once
// The table of units: quantity, factor and offset to SI, spellings. Spellings are as normalised by units.cpp: small
// letters (but see there for m and M), no blanks, "deg" for a degree sign.

#include <array>
#include <string_view>

namespace ehm::units {

struct Unit {
  std::string_view quantity;
  double factor, offset;       ///< SI = factor * value + offset
  std::string_view name;       ///< as messages write it
  std::string_view spellings;  ///< others, blank separated
};

namespace definition {
inline constexpr double pi = 3.14159265358979323846;
inline constexpr double inch = 0.0254, foot = 0.3048, nautical_mile = 1852.0, mile = 1609.344;
inline constexpr double pound = 0.45359237, gravity = 9.80665;
inline constexpr double pound_force = pound * gravity, psi = pound_force / (inch * inch);
inline constexpr double mercury_mm = 13595.1 * gravity * 1e-3, water_mm = 1000.0 * gravity * 1e-3;
inline constexpr double horsepower = 550.0 * foot * pound_force;
inline constexpr double fahrenheit_zero = 459.67 * 5.0 / 9.0;
}  // namespace definition

// clang-format off
inline constexpr std::array table{
    Unit{"temperature", 1.0, 0.0, "K", "k degk kelvin"},
    Unit{"temperature", 1.0, 273.15, "degC", "c celsius"},
    Unit{"temperature", 5.0 / 9.0, definition::fahrenheit_zero, "degF", "f fahrenheit"},
    Unit{"temperature", 5.0 / 9.0, 0.0, "degR", "r rankine"},

    Unit{"pressure", 1.0, 0.0, "Pa", "paa n/m2 pascal"},
    Unit{"pressure", 1e2, 0.0, "hPa", "hpaa"},
    Unit{"pressure", 1e3, 0.0, "kPa", "kpaa"},
    Unit{"pressure", 1e6, 0.0, "MPa", "MPaa n/mm2"},
    Unit{"pressure", 1e2, 0.0, "mbar", "mbara mb"},
    Unit{"pressure", 1e5, 0.0, "bar", "bara"},
    Unit{"pressure", definition::psi, 0.0, "psi", "psia lbf/in2 lb/in2 lbf/sqin"},
    Unit{"pressure", definition::pound_force / (definition::foot * definition::foot), 0.0, "psf", "psfa lbf/ft2 lb/ft2"},
    Unit{"pressure", definition::mercury_mm * 25.4, 0.0, "inHg", ""},
    Unit{"pressure", definition::mercury_mm, 0.0, "mmHg", ""},
    Unit{"pressure", definition::water_mm * 25.4, 0.0, "inH2O", ""},
    Unit{"pressure", definition::water_mm, 0.0, "mmH2O", ""},
    Unit{"pressure", 101325.0 / 760.0, 0.0, "torr", ""},
    Unit{"pressure", 101325.0, 0.0, "atm", ""},
    Unit{"pressure", definition::gravity * 1e4, 0.0, "kgf/cm2", "kg/cm2"},

    Unit{"gauge pressure", 1.0, 0.0, "Pag", ""},
    Unit{"gauge pressure", 1e3, 0.0, "kPag", ""},
    Unit{"gauge pressure", 1e2, 0.0, "mbarg", ""},
    Unit{"gauge pressure", 1e5, 0.0, "barg", ""},
    Unit{"gauge pressure", definition::psi, 0.0, "psig", ""},

    Unit{"force", 1.0, 0.0, "N", "newton"},
    Unit{"force", 10.0, 0.0, "daN", ""},
    Unit{"force", 1e3, 0.0, "kN", ""},
    Unit{"force", definition::pound_force, 0.0, "lbf", ""},
    Unit{"force", 1e3 * definition::pound_force, 0.0, "klbf", ""},
    Unit{"force", definition::gravity, 0.0, "kgf", "kp"},

    Unit{"mass flow", 1.0, 0.0, "kg/s", "kgs-1 kg/sec kgps"},
    Unit{"mass flow", 1e-3, 0.0, "g/s", "gs-1 g/sec"},
    Unit{"mass flow", 1.0 / 60.0, 0.0, "kg/min", "kgmin-1"},
    Unit{"mass flow", 1.0 / 3600.0, 0.0, "kg/h", "kgh-1 kg/hr kghr-1 kgph"},
    Unit{"mass flow", 1.0 / 3.6, 0.0, "t/h", "th-1 t/hr"},
    Unit{"mass flow", definition::pound, 0.0, "lbm/s", "lb/s lbms-1 lbs-1 lbm/sec lb/sec pps"},
    Unit{"mass flow", definition::pound / 60.0, 0.0, "lbm/min", "lb/min lbmmin-1 lbmin-1"},
    Unit{"mass flow", definition::pound / 3600.0, 0.0, "lbm/h", "lb/h lbm/hr lb/hr lbmh-1 lbh-1 lbmhr-1 lbhr-1 pph"},

    Unit{"speed of rotation", definition::pi / 30.0, 0.0, "rpm", "1/min min-1 r/min rev/min revmin-1 u/min"},
    Unit{"speed of rotation", definition::pi * 1e3 / 30.0, 0.0, "krpm", ""},
    Unit{"speed of rotation", 2.0 * definition::pi, 0.0, "rev/s", "rps r/s hz 1/s s-1 revs-1"},
    Unit{"speed of rotation", 1.0, 0.0, "rad/s", "rads-1 rad/sec"},
    Unit{"speed of rotation", definition::pi / 180.0, 0.0, "deg/s", "degs-1 deg/sec"},

    Unit{"ratio", 1.0, 0.0, "fraction", "- 1 ratio none dimensionless mach Mach"},
    Unit{"ratio", 0.01, 0.0, "percent", "% pct"},

    Unit{"length", 1.0, 0.0, "m", "meter metre"},
    Unit{"length", 1e-2, 0.0, "cm", ""},
    Unit{"length", 1e-3, 0.0, "mm", ""},
    Unit{"length", 1e3, 0.0, "km", ""},
    Unit{"length", definition::inch, 0.0, "in", "inch"},
    Unit{"length", definition::foot, 0.0, "ft", "foot feet"},
    Unit{"length", 1e3 * definition::foot, 0.0, "kft", "1000ft"},

    Unit{"speed", 1.0, 0.0, "m/s", "ms-1"},
    Unit{"speed", 1.0 / 3.6, 0.0, "km/h", "kmh-1"},
    Unit{"speed", definition::foot, 0.0, "ft/s", "fts-1"},
    Unit{"speed", definition::nautical_mile / 3600.0, 0.0, "kt", "kts knot knots"},
    Unit{"speed", definition::mile / 3600.0, 0.0, "mph", ""},
    Unit{"speed", definition::inch, 0.0, "in/s", "ips"},
    Unit{"speed", 1e-3, 0.0, "mm/s", ""},

    Unit{"angle", 1.0, 0.0, "rad", "radian"},
    Unit{"angle", definition::pi / 180.0, 0.0, "deg", "degree degrees"},

    Unit{"power", 1.0, 0.0, "W", "watt"},
    Unit{"power", 1e3, 0.0, "kW", ""},
    Unit{"power", 1e6, 0.0, "MW", ""},
    Unit{"power", definition::horsepower, 0.0, "hp", "shp"},

    Unit{"torque", 1.0, 0.0, "N m", "nm"},
    Unit{"torque", 1e3, 0.0, "kN m", "knm"},
    Unit{"torque", definition::foot * definition::pound_force, 0.0, "lbf ft", "lbfft ftlbf ft-lbf lbf-ft ftlb lbft"},
};
// clang-format on

}  // namespace ehm::units
