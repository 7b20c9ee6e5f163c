// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/report/page/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tuner_design/report/page/text.h"

namespace ehm::tuner_design::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// 1, 2 or 5 times a power of ten, at least `least`.
double nice_step(double least) {
  const double decade = std::pow(10.0, std::floor(std::log10(least)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= least * (1.0 - 1e-9)) return factor * decade;
  }
  return 10.0 * decade;
}

std::string linear_label(double value, double step) {
  if (std::abs(value) < 1e-9 * step) return "0";
  const int exponent = static_cast<int>(std::floor(std::log10(step) + 1e-9));
  if (exponent < -4 || std::abs(value) >= 1e6) return number(value, 2);
  const std::string text = fmt::format("{:.{}f}", value, std::max(0, -exponent));
  return text[0] == '-' ? "−" + text.substr(1) : text;
}

std::string log_label(double mantissa, int exponent) {
  if (exponent < -3 || exponent > 4)
    return (mantissa > 1.0 ? fmt::format("{:.0f}×", mantissa) : "") + power_of_ten(exponent);
  return fmt::format("{:.{}f}", mantissa * std::pow(10.0, exponent), std::max(0, -exponent));
}

}  // namespace

Axis Axis::linear(const std::vector<double>& values, bool with_zero, int wanted) {
  double low = with_zero ? 0.0 : infinity, high = with_zero ? 0.0 : -infinity;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (!(low <= high)) low = high = 0.0;
  if (low == high) high += low == 0.0 ? 1.0 : std::abs(low);
  const double step = nice_step((high - low) / std::max(1, wanted));
  Axis axis;
  axis.low_ = step * std::floor(low / step + 1e-9);
  axis.high_ = step * std::ceil(high / step - 1e-9);
  const int steps = static_cast<int>(std::lround((axis.high_ - axis.low_) / step));
  for (int i = 0; i <= steps; ++i) {
    const double value = axis.low_ + i * step;
    axis.ticks_.push_back({value, linear_label(value, step)});
  }
  return axis;
}

Axis Axis::logarithmic(const std::vector<double>& values, int wanted) {
  double low = infinity, high = 0.0;
  for (const double value : values) {
    if (!std::isfinite(value) || value <= 0.0) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (high == 0.0) low = 1.0, high = 10.0;
  const int first = static_cast<int>(std::floor(std::log10(low) + 1e-9));
  const int last = std::max(first + 1, static_cast<int>(std::ceil(std::log10(high) - 1e-9)));
  Axis axis;
  axis.logarithmic_ = true;
  axis.low_ = std::pow(10.0, first);
  axis.high_ = std::pow(10.0, last);
  const int every = (last - first + wanted - 1) / std::max(1, wanted);
  const bool fine = 3 * (last - first) <= wanted;
  for (int exponent = first; exponent <= last; ++exponent) {
    const bool labelled = (exponent - first) % every == 0;
    axis.ticks_.push_back({std::pow(10.0, exponent), labelled ? log_label(1.0, exponent) : ""});
    if (exponent == last || every > 1) continue;
    for (int mantissa = 2; mantissa < 10; ++mantissa) {
      const bool also = fine && (mantissa == 2 || mantissa == 5);
      axis.ticks_.push_back({mantissa * std::pow(10.0, exponent), also ? log_label(mantissa, exponent) : ""});
    }
  }
  return axis;
}

bool Axis::shows(double value) const {
  return std::isfinite(value) && (!logarithmic_ || value > 0.0);
}

double Axis::fraction(double value) const {
  if (!shows(value)) return 0.0;
  const double part = logarithmic_ ? (std::log10(value) - std::log10(low_)) / (std::log10(high_) - std::log10(low_))
                                   : (value - low_) / (high_ - low_);
  return std::clamp(part, 0.0, 1.0);
}

}  // namespace ehm::tuner_design::report
