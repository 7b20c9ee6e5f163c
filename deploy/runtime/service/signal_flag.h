// SPDX-License-Identifier: Apache-2.0
#pragma once
// A signal as a flag that any thread may read. One flag for each Tag; setting it is safe in a signal handler, since the
// atomic needs no lock and there is nothing else to do.

#include <atomic>
#include <csignal>

namespace ehm::service {

template <class Tag>
class SignalFlag {
 public:
  /// Installs the handler; `flags` as for sigaction.
  static void raise_on(int signal, int flags) {
    struct sigaction action {};
    action.sa_handler = [](int) { flag_.store(true, std::memory_order_relaxed); };
    action.sa_flags = flags;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
  static bool raised() noexcept { return flag_.load(std::memory_order_relaxed); }
  /// True once for all signals since the last call.
  static bool take() noexcept { return flag_.exchange(false, std::memory_order_relaxed); }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free);
  static inline std::atomic<bool> flag_{false};
};

}  // namespace ehm::service
