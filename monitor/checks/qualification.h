// SPDX-License-Identifier: Apache-2.0
#pragma once
// From single bad values to a verdict on the sensor, with hysteresis and requalification time:
//
//   trusted --bad value--> bridged      bridged --bridge_samples bad in a row--> excluded
//                                       bridged --good value--> trusted
//   excluded --requalify_samples good in a row--> trusted     excluded --bad value--> the count starts anew
//
// Real-time safe: yes.

#include <cstdint>

#include "monitor/data/options.h"

namespace ehm::monitor {

class Qualification {
 public:
  enum class State { trusted, bridged, excluded };

  /// Takes the verdict on one sample; returns the state after it.
  State observe(bool good, const CheckOptions& options) noexcept {
    if (state_ == State::excluded) {
      run_ = good ? run_ + 1 : 0;
      if (run_ >= options.requalify_samples) become(State::trusted);
    } else if (good) {
      become(State::trusted);
    } else {
      state_ = State::bridged;
      if (++run_ > options.bridge_samples) become(State::excluded);
    }
    return state_;
  }
  State state() const noexcept { return state_; }
  void reset() noexcept { become(State::trusted); }
  /// As after a declared fault; the count of good values starts anew.
  void exclude() noexcept { become(State::excluded); }

 private:
  void become(State state) noexcept {
    state_ = state;
    run_ = 0;
  }
  State state_ = State::trusted;
  std::int64_t run_ = 0;  ///< bad values while bridged, good ones while excluded
};

}  // namespace ehm::monitor
