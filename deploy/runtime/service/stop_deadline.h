// SPDX-License-Identifier: Apache-2.0
#pragma once
// A stop that is asked for ends within a limit, whatever a disk, a terminal or a middleware do: what is not done by
// then is left, and the process ends. Subscribers and systemd have been told before (the release of the engines and
// STOPPING=1 come first), and files are whole at any moment.

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "deploy/runtime/service/exit_code.h"
#include "deploy/runtime/service/stop_signal.h"

namespace ehm::service {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::chrono::seconds longest_stop{30};
#else
inline constexpr std::chrono::seconds longest_stop{2};
#endif

class StopDeadline {
 public:
  /// The thread outlives everything, also the objects that are destroyed after main.
  StopDeadline() {
    std::thread([] {
      const StopSignal stop;
      while (!stop.requested()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
      std::this_thread::sleep_for(longest_stop);
      _exit(code().load());
    }).detach();
  }
  /// From now on only the log and the end of the process are left.
  static void in_order() { code().store(exit_ok); }

 private:
  static std::atomic<int>& code() {
    static std::atomic<int> code{exit_failed};
    return code;
  }
};

}  // namespace ehm::service
