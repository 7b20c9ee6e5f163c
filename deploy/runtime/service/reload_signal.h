// SPDX-License-Identifier: Apache-2.0
#pragma once
// SIGHUP as a flag: the operator asks for the configuration to be read again.

#include "deploy/runtime/service/signal_flag.h"

namespace ehm::service {

class ReloadSignal {
 public:
  /// Installs the handler; without it the signal would end the program.
  ReloadSignal() { Flag::raise_on(SIGHUP, SA_RESTART); }
  /// True once for all signals since the last call.
  bool take() const noexcept { return Flag::take(); }

 private:
  using Flag = SignalFlag<ReloadSignal>;
};

}  // namespace ehm::service
