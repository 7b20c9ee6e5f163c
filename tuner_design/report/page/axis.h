// SPDX-License-Identifier: Apache-2.0
#pragma once
// From values to a length: linear, fraction = (v - low)/(high - low), or logarithmic, the same of log10. Ticks at 1, 2
// or 5 times a power of ten. Whatever the values are (none, all equal, zeros, not finite), the axis is one that can be
// drawn. Errors: none.

#include <string>
#include <vector>

namespace ehm::tuner_design::report {

struct Tick {
  double value;
  std::string label;  ///< empty for a minor tick
};

class Axis {
 public:
  /// Holds zero if `with_zero`; of `values` those that are not finite are left out. About `wanted` ticks.
  static Axis linear(const std::vector<double>& values, bool with_zero, int wanted);
  /// Of `values` only the positive ones count. At most `wanted` labels and a few more.
  static Axis logarithmic(const std::vector<double>& values, int wanted);

  /// 0 at the low end, 1 at the high end, cut to that; 0 for what a logarithmic axis cannot show.
  double fraction(double value) const;
  bool shows(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }
  bool is_logarithmic() const { return logarithmic_; }

 private:
  double low_ = 0.0, high_ = 1.0;
  bool logarithmic_ = false;
  std::vector<Tick> ticks_;
};

}  // namespace ehm::tuner_design::report
