#pragma once
// Feeds systemd's watchdog (WatchdogSec=, sd_watchdog_enabled(3)) only while a loop makes progress: a thread that looks
// at the loop's turn counter twice per WATCHDOG_USEC, and sends WATCHDOG=1 if it has grown since the last look. A hung
// loop is not fed, whatever else in the process still runs, and systemd restarts the service.
//
// Without WATCHDOG_USEC there is no thread.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace ehm::service {

/// Grows with every turn of a loop. Real-time safe: a relaxed store by the one thread that turns.
class TurnCounter {
 public:
  void turned() noexcept { turns_.store(turns_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  std::uint64_t turns() const noexcept { return turns_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> turns_{0};
};

class Watchdog {
 public:
  /// `loop` must outlive this. `what` names the loop in the log line that says why it is not fed.
  Watchdog(const TurnCounter& loop, const char* what);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  void run();

  const TurnCounter& loop_;
  const char* what_;
  std::chrono::microseconds period_{0};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace ehm::service
