// SPDX-License-Identifier: Apache-2.0
#pragma once
// Bounded queue from one thread to one other without locks: what leaves the cycle thread goes through it.
//
// Indices only grow; slot = index mod Capacity. The producer publishes a slot by a release store of its index, the
// consumer frees one likewise. A full queue refuses and counts. Real-time safe: push yes, pop yes.

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace ehm::monitor {

template <class T, std::size_t Capacity>
class SpscQueue {
 public:
  SpscQueue() = default;
  /// Every slot begins as `each`: for a T whose copy allocates nothing into one of the same size.
  explicit SpscQueue(const T& each) { slots_.fill(each); }

  bool push(const T& value) noexcept {
    const std::uint64_t tail = tail_.load(std::memory_order_relaxed);
    if (tail - head_.load(std::memory_order_acquire) == Capacity) {
      overflow_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[tail % Capacity] = value;
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }
  bool pop(T& value) noexcept {
    const std::uint64_t head = head_.load(std::memory_order_relaxed);
    if (head == tail_.load(std::memory_order_acquire)) return false;
    value = slots_[head % Capacity];
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  /// For the producer: would a push succeed?
  bool has_room() const noexcept {
    return tail_.load(std::memory_order_relaxed) - head_.load(std::memory_order_acquire) < Capacity;
  }
  /// Values refused so far, because the consumer was too slow.
  std::uint64_t overflow() const noexcept { return overflow_.load(std::memory_order_relaxed); }

 private:
  std::array<T, Capacity> slots_{};
  alignas(64) std::atomic<std::uint64_t> head_{0};
  alignas(64) std::atomic<std::uint64_t> tail_{0};
  std::atomic<std::uint64_t> overflow_{0};
};

}  // namespace ehm::monitor
