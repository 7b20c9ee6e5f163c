// SPDX-License-Identifier: Apache-2.0
#pragma once
// Is the engine where its estimator's model holds? Valid up to a distance of 1 tolerance, and again below 0.9. Outside,
// the estimates would be extrapolation without a stated error: they are withheld. Real-time safe: yes.

#include "monitor/data/events.h"

namespace ehm::monitor {

class Validity {
 public:
  bool check(double distance, EventList& events) noexcept {
    condition_.set(distance > (condition_.raised() ? 0.9 : 1.0),
                   {.kind = idl::EventKind::operating_point, .value = distance, .threshold = 1.0}, events);
    return !condition_.raised();
  }
  void end_with_design(EventList& events) noexcept {
    condition_.end_with_design(idl::EventKind::operating_point, 0, events);
  }

 private:
  Condition condition_;
};

}  // namespace ehm::monitor
