// SPDX-License-Identifier: Apache-2.0
#pragma once
// Largest and rms deviation of a fit from its samples, in the unit of what is added.

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace ehm::engine_sim {

class Deviation {
 public:
  void add(double d) {
    sum_ += d * d;
    largest_ = std::max(largest_, std::abs(d));
    ++count_;
  }
  /// "rms 0.1 max 0.3"; zeros if nothing was added.
  std::string text() const {
    std::ostringstream out;
    out.precision(3);
    out << "rms " << std::sqrt(sum_ / std::max(count_, 1)) << " max " << largest_;
    return out.str();
  }

 private:
  double sum_ = 0.0, largest_ = 0.0;
  int count_ = 0;
};

}  // namespace ehm::engine_sim
