#pragma once
// Is the engine where the design's linear model holds? distance = the largest of |flight - point| / tolerance and
// |actuator - trim| / tolerance; valid up to 1, and again below 0.9. The tolerance of an actuator is a percentage of
// its trim, but its own for degrees and fractions, whose trim may be zero; with a trim that has no size (scaling.h) in
// another unit it is not judged.
//
// Outside, the estimates would be extrapolation without a stated error: they are withheld. Real-time safe: yes.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine_sim/linear_model/scaling.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/data/sample.h"

namespace ehm::monitor {

class Validity {
 public:
  /// `model` must outlive this.
  Validity(const ValidityOptions& options, const linear_model::LinearModel& model) : options_(options), model_(&model) {
    for (std::size_t i = 0; i < model.controls.size(); ++i) tolerance_[i] = tolerance(options, model.controls[i]);
  }

  bool judge(const Sample& sample, EventList& events) noexcept {
    const double distance = distance_of(sample);
    condition_.set(distance > (condition_.raised() ? 0.9 : 1.0),
                   {idl::EventKind::operating_point, 0, false, distance, 1.0, 0}, events);
    return !condition_.raised();
  }
  void end_with_design(EventList& events) noexcept {
    condition_.end_with_design(idl::EventKind::operating_point, 0, events);
  }

 private:
  double distance_of(const Sample& s) const noexcept {
    double distance = 0.0;
    if (model_->operating_point) {
      const auto& p = *model_->operating_point;
      distance = std::max({std::abs(s.flight.altitude_m - p.altitude_m) / options_.altitude_m,
                           std::abs(s.flight.mach - p.mach) / options_.mach,
                           std::abs(s.flight.delta_isa_k - p.delta_isa_k) / options_.delta_isa_k});
    }
    for (std::size_t i = 0; i < model_->controls.size(); ++i)
      distance = std::max(distance, std::abs(s.actuator[i] - model_->controls[i].trim) / tolerance_[i]);
    return distance;
  }

  static double tolerance(const ValidityOptions& options, const linear_model::Channel& actuator) {
    if (actuator.unit == "deg") return options.vane_deg;
    if (actuator.unit == "fraction") return options.bleed_fraction;
    const double tolerance = 0.01 * options.actuator_percent * linear_model::size_of_trim(actuator);
    return tolerance > 0.0 ? tolerance : std::numeric_limits<double>::infinity();
  }

  ValidityOptions options_;
  const linear_model::LinearModel* model_;
  std::array<double, estimation::max_actuators> tolerance_{};
  Condition condition_;
};

}  // namespace ehm::monitor
