// SPDX-License-Identifier: Apache-2.0
#pragma once
// Messages from any threads but the cycle's to one that takes them in its turns.
//
// Bounded: what does not fit between two turns is counted. Real-time safe: no, it locks and allocates; the cycle thread
// has queues.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace ehm::monitor {

template <class Message>
class Mailbox {
 public:
  void post(Message message) {
    const std::lock_guard lock(mutex_);
    if (messages_.size() < capacity)
      messages_.push_back(std::move(message));
    else
      lost_.fetch_add(1, std::memory_order_relaxed);
  }
  /// All that were posted since the last call, in order.
  std::vector<Message> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
  }
  std::uint64_t lost() const noexcept { return lost_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t capacity = 256;
  std::mutex mutex_;
  std::vector<Message> messages_;
  std::atomic<std::uint64_t> lost_{0};
};

}  // namespace ehm::monitor
