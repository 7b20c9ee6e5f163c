// SPDX-License-Identifier: Apache-2.0
#pragma once
// Limits on estimates: raised when the estimate leaves [min, max], cleared when it is back inside by the hysteresis.
//
// @throws std::invalid_argument at construction if a limit names no health or auxiliary channel of the model.

#include <vector>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/estimation/capacity.h"

namespace ehm::monitor {

class LimitWatch {
 public:
  LimitWatch(const std::vector<LimitOptions>& limits, const linear_model::LinearModel& model);

  /// Real-time safe: yes.
  void check(const estimation::HealthVector& health, const estimation::AuxiliaryVector& auxiliary,
             EventList& events) noexcept;
  void end_with_design(EventList& events) noexcept {
    for (Limit& l : limits_) l.condition.end_with_design(l.kind, static_cast<std::uint32_t>(l.channel), events);
  }

 private:
  struct Limit {
    idl::EventKind kind;
    int channel;
    double min, max, hysteresis;
    Condition condition;
  };
  std::vector<Limit> limits_;
};

}  // namespace ehm::monitor
