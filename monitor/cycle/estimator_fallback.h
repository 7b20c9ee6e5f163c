// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whose estimate is published where the published estimator has none: at the design's point the watch filter flies with
// it on the same samples, and takes its place after three samples in a row without an answer, until it has answered
// for as long as a sensor needs to qualify again. Its event names neither: whoever publishes it knows both.
// Errors: none. Real-time safe: yes.

#include "monitor/data/events.h"

namespace ehm::monitor {

class EstimatorFallback {
 public:
  static constexpr int most_unanswered = 3, answers_to_return = 200;

  /// One more sample at the point. @returns whether the watch filter's estimate is to be published.
  bool look(bool answered, EventList& events) noexcept {
    unanswered_ = answered ? 0 : unanswered_ + 1;
    answers_ = answered ? answers_ + 1 : 0;
    if (unanswered_ >= most_unanswered) set(true, unanswered_, events);
    if (answers_ >= answers_to_return) set(false, answers_, events);
    return fallen_.raised();
  }
  /// Away from the point, or anew: nothing takes anybody's place.
  void end(EventList& events) noexcept {
    set(false, 0, events);
    unanswered_ = answers_ = 0;
  }
  bool fallen() const noexcept { return fallen_.raised(); }

 private:
  void set(bool fallen, int samples, EventList& events) noexcept {
    fallen_.set(fallen,
                {.kind = idl::EventKind::estimator_fallback,
                 .value = static_cast<double>(samples),
                 .threshold = static_cast<double>(fallen ? most_unanswered : answers_to_return)},
                events);
  }
  Condition fallen_;
  int unanswered_ = 0, answers_ = 0;  ///< samples in a row
};

}  // namespace ehm::monitor
