// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/watchdog.h"

#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>

namespace ehm::service {

Watchdog::Watchdog(std::vector<WatchedLoop> loops) {
  for (const WatchedLoop& loop : loops) loops_.push_back({loop});
  std::uint64_t limit_us = 0;
  if (sd_watchdog_enabled(0, &limit_us) <= 0) return;
  period_ = std::chrono::microseconds(limit_us / 2);
  thread_ = std::thread([this] { run(); });
}

Watchdog::~Watchdog() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Watchdog::run() {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, period_, [this] { return stop_; }))
    if (all_turn()) static_cast<void>(sd_notify(0, "WATCHDOG=1"));
}

bool Watchdog::all_turn() {
  bool all = true;
  for (Watched& watched : loops_) {
    const std::uint64_t turns = watched.loop.turns->turns();
    const bool hung = turns == watched.turns;
    if (hung && !watched.hung)
      spdlog::error("the {} has not turned for {:.1f} s, the watchdog is not fed", watched.loop.name,
                    std::chrono::duration<double>(period_).count());
    if (!hung && watched.hung) spdlog::warn("the {} turns again", watched.loop.name);
    watched.turns = turns;
    watched.hung = hung;
    all = all && !hung;
  }
  return all;
}

}  // namespace ehm::service
