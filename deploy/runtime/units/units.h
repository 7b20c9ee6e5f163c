// SPDX-License-Identifier: Apache-2.0
#pragma once
// Units of channels: which ones are the same quantity, and how a value goes from one to the other. The one table of
// units in this project.
//
//   value in SI = factor * value + offset          so       to = (f_from / f_to) * from + (o_from - o_to) / f_to
//
// An offset belongs to temperatures: 0 degC is 273.15 K. A difference of two temperatures, and a standard deviation,
// has none (of_differences). Gauge pressures are a quantity of their own, since they say nothing without the ambient
// one.
//
// Factors come from definitions (SI brochure, 9th edition; NIST SP 811): inch 0.0254 m, foot 0.3048 m, nautical mile
// 1852 m, pound 0.45359237 kg, standard gravity 9.80665 m/s^2, atmosphere 101325 Pa, mercury of 13595.1 kg/m^3, water
// of 1000 kg/m^3.
//
// Spelling: blanks, underscores, brackets around the whole and a degree sign do not matter, nor do * and . between
// units, ^, "deg" and "degrees" before a temperature scale, or capitals, except where a unit begins with m or M (mPa is
// not MPa).
//
// Real-time safe: conversion() and is_gauge_pressure() yes, the others no.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ehm::units {

struct Conversion {
  double factor = 1.0, offset = 0.0;

  double operator()(double value) const noexcept { return factor * value + offset; }
  bool operator==(const Conversion&) const = default;
  bool changes() const noexcept { return factor != 1.0 || offset != 0.0; }
  /// For differences and standard deviations.
  Conversion of_differences() const noexcept { return {factor, 0.0}; }
};

/// From one unit to the other. The same text twice, or no text on one side (nothing is said), is no change; nothing if
/// a unit is not known, or the two are different quantities.
std::optional<Conversion> conversion(std::string_view from, std::string_view to) noexcept;

/// A pressure above the ambient one, which the unit does not tell: neither its zero nor a share of it means anything.
bool is_gauge_pressure(std::string_view unit) noexcept;

/// Why conversion() has nothing to say: which unit is not known, or which quantities the two are.
std::string why_not(std::string_view from, std::string_view to);

/// The known units of the same quantity, by their first spelling, without the unit itself; none if it is not known.
std::vector<std::string> relatives(std::string_view unit);

}  // namespace ehm::units
