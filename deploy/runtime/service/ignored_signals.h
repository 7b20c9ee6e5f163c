// SPDX-License-Identifier: Apache-2.0
#pragma once
// Signals whose default is to end the process for what a service has to live with: a log reader that has gone
// (SIGPIPE), a limit on the size of files (SIGXFSZ). The call that met it fails, and is reported as any failure.
// Call it first in main.

#include <csignal>

namespace ehm::service {

inline void ignore_fatal_signals() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace ehm::service
