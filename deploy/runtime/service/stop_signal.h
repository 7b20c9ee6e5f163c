// SPDX-License-Identifier: Apache-2.0
#pragma once
// SIGINT and SIGTERM as a flag that loops poll and sleeps are interrupted by.

#include "deploy/runtime/service/signal_flag.h"

namespace ehm::service {

class StopSignal {
 public:
  /// Installs the handlers; without SA_RESTART, so that a blocking sleep returns at once.
  StopSignal() {
    Flag::raise_on(SIGINT, 0);
    Flag::raise_on(SIGTERM, 0);
  }
  bool requested() const noexcept { return Flag::raised(); }

 private:
  using Flag = SignalFlag<StopSignal>;
};

}  // namespace ehm::service
