// SPDX-License-Identifier: Apache-2.0
#pragma once
// How far an engine is from where a linear model was made, in tolerances: the largest of |flight - point| / tolerance
// and |actuator - trim| / tolerance. The tolerance of an actuator is a percentage of its trim, but its own for degrees
// and fractions, whose trim may be zero; with a trim that has no size (scaling.h) in another unit it is not judged. A
// model without an operating point holds in every flight. Real-time safe: yes.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/linear_model.h"
#include "engine_sim/linear_model/scaling.h"
#include "monitor/data/options.h"
#include "monitor/estimation/estimator.h"

namespace ehm::estimation {

class PointDistance {
 public:
  PointDistance(const monitor::ValidityOptions& options, const linear_model::LinearModel& model)
      : options_(options), point_(model.operating_point), actuators_(model.controls.size()) {
    for (std::size_t i = 0; i < actuators_; ++i) {
      trim_[i] = model.controls[i].trim;
      tolerance_[i] = tolerance(options, model.controls[i]);
    }
  }

  [[nodiscard]] double of(const Conditions& now) const noexcept {
    double distance = 0.0;
    if (point_) {
      distance = std::max({std::abs(now.flight.altitude_m - point_->altitude_m) / options_.altitude_m,
                           std::abs(now.flight.mach - point_->mach) / options_.mach,
                           std::abs(now.flight.delta_isa_k - point_->delta_isa_k) / options_.delta_isa_k});
    }
    for (std::size_t i = 0; i < actuators_; ++i)
      distance = std::max(distance, std::abs(now.actuators(as_index(i)) - trim_[i]) / tolerance_[i]);
    return distance;
  }

 private:
  static double tolerance(const monitor::ValidityOptions& options, const linear_model::Channel& actuator) {
    if (actuator.unit == "deg") return options.vane_deg;
    if (actuator.unit == "fraction") return options.bleed_fraction;
    const double tolerance = 0.01 * options.actuator_percent * linear_model::size_of_trim(actuator);
    return tolerance > 0.0 ? tolerance : std::numeric_limits<double>::infinity();
  }

  monitor::ValidityOptions options_;
  std::optional<linear_model::OperatingPoint> point_;
  std::size_t actuators_;
  std::array<double, max_actuators> trim_{}, tolerance_{};
};

}  // namespace ehm::estimation
