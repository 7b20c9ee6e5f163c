#include "deploy/service/watchdog.h"

#include <spdlog/spdlog.h>
#include <systemd/sd-daemon.h>

namespace ehm::service {

Watchdog::Watchdog(const TurnCounter& loop, const char* what) : loop_(loop), what_(what) {
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
  std::uint64_t fed = 0;
  bool hung = false;
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, period_, [this] { return stop_; })) {
    const std::uint64_t turns = loop_.turns();
    if (turns != fed) {
      fed = turns;
      if (hung) spdlog::warn("the {} turns again, the watchdog is fed", what_);
      hung = false;
      static_cast<void>(sd_notify(0, "WATCHDOG=1"));
    } else if (!hung) {
      hung = true;
      spdlog::error("the {} has not turned for {:.1f} s, the watchdog is not fed", what_,
                    std::chrono::duration<double>(period_).count());
    }
  }
}

}  // namespace ehm::service
