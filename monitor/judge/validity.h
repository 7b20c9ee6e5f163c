#pragma once
// Is the engine where the design's linear model holds? distance = the largest of |flight - point| / tolerance and
// |actuator - trim| / tolerance; valid up to 1, and again below 0.9.
//
// Outside, the estimates would be extrapolation without a stated error: they are withheld. Real-time safe: yes.

#include <algorithm>
#include <cmath>

#include "monitor/judge/events.h"
#include "monitor/options.h"
#include "monitor/sample.h"

namespace ehm::monitor {

class Validity {
 public:
  Validity(const ValidityOptions& options, const estimation::LinearModel& model) : options_(options), model_(model) {}

  bool judge(const Sample& sample, EventList& events) noexcept {
    const double distance = distance_of(sample);
    condition_.set(distance > (condition_.raised() ? 0.9 : 1.0),
                   {wire::EventKind::operating_point, 0, false, distance, 1.0, 0}, events);
    return !condition_.raised();
  }

 private:
  double distance_of(const Sample& s) const noexcept {
    double distance = 0.0;
    if (model_.operating_point) {
      const auto& p = *model_.operating_point;
      distance = std::max({std::abs(s.flight.altitude_m - p.altitude_m) / options_.altitude_m,
                           std::abs(s.flight.mach - p.mach) / options_.mach,
                           std::abs(s.flight.delta_isa_k - p.delta_isa_k) / options_.delta_isa_k});
    }
    for (std::size_t i = 0; i < model_.controls.size(); ++i)
      if (const double trim = std::abs(model_.controls[i].trim); trim > 0.0)
        distance = std::max(
            distance, 100.0 * std::abs(s.actuator[i] - model_.controls[i].trim) / trim / options_.actuator_percent);
    return distance;
  }

  ValidityOptions options_;
  const estimation::LinearModel& model_;
  Condition condition_;
};

}  // namespace ehm::monitor
