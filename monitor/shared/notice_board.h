// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the middleware's threads, or others beside the cycle, have to say: conditions that began or ended and that no
// sample decided. Any thread but the cycle's posts; the reporter takes, logs and publishes each as a HealthEvent.
//
// Bounded: what does not fit between two turns of the reporter is counted (MonitorStatus.reports_lost).
// Real-time safe: no, it locks and allocates; the cycle thread has the report queue.

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "idl/wire_values.h"

namespace ehm::monitor {

struct Notice {
  idl::EventKind kind{};
  bool raised = false;
  std::string text;
  std::uint32_t engine_id = 0;  ///< 0: the whole monitor
  double value = 0.0;
  double threshold = 0.0;
};

class NoticeBoard {
 public:
  void post(Notice notice) {
    const std::lock_guard lock(mutex_);
    if (notices_.size() < capacity)
      notices_.push_back(std::move(notice));
    else
      lost_.fetch_add(1, std::memory_order_relaxed);
  }
  /// All that were posted since the last call, in order.
  std::vector<Notice> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notices_, {});
  }
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t capacity = 256;
  std::mutex mutex_;
  std::vector<Notice> notices_;
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace ehm::monitor
