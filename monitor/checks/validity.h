// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is the engine where an estimator's model holds? Valid up to a distance of 1 tolerance, and again below 0.9. Outside,
// the estimates would be extrapolation without a stated error: they are withheld. Real-time safe: yes.

#include "monitor/data/events.h"

namespace ehm::monitor {

/// By the distance alone.
class Within {
 public:
  bool check(double distance) noexcept { return within_ = !(distance > (within_ ? 1.0 : 0.9)); }

 private:
  bool within_ = true;
};

/// With the event that tells it.
class Validity {
 public:
  bool check(double distance, EventList& events) noexcept {
    const bool valid = within_.check(distance);
    condition_.set(!valid, {.kind = idl::EventKind::operating_point, .value = distance, .threshold = 1.0}, events);
    return valid;
  }
  void end_with_design(EventList& events) noexcept {
    condition_.end_with_design(idl::EventKind::operating_point, 0, events);
    within_ = {};
  }

 private:
  Within within_;
  Condition condition_;
};

}  // namespace ehm::monitor
