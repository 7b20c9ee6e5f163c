// SPDX-License-Identifier: Apache-2.0
#pragma once
// Feeds systemd's watchdog (WatchdogSec=, sd_watchdog_enabled(3)) only while every loop makes progress: a thread that
// looks at their turn counters twice per WATCHDOG_USEC, and sends WATCHDOG=1 if all have grown since the last look.
// With a hung loop it is not fed, whatever else in the process still runs, and systemd restarts the service.
//
// Without WATCHDOG_USEC there is no thread.

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace ehm::service {

/// Grows with every turn of a loop. Real-time safe: a relaxed store by the one thread that turns.
class TurnCounter {
 public:
  void turned() noexcept { turns_.store(turns_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed); }
  std::uint64_t turns() const noexcept { return turns_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> turns_{0};
};

/// `name` stands in the log line that says why the watchdog is not fed.
struct WatchedLoop {
  const TurnCounter* turns;
  const char* name;
};

class Watchdog {
 public:
  /// The counters must outlive this.
  explicit Watchdog(std::vector<WatchedLoop> loops);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

 private:
  struct Watched {
    WatchedLoop loop;
    std::uint64_t turns = 0;  ///< at the last look
    bool hung = false;
  };
  void run();
  bool all_turn();

  std::vector<Watched> loops_;
  std::chrono::microseconds period_{0};
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace ehm::service
