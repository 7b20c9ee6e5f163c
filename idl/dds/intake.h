// SPDX-License-Identifier: Apache-2.0
#pragma once
// What has come in on one topic, counted where it comes in: the writers that have been read, and the messages that
// could not be.
//
// Real-time safe: yes, no lock, no allocation. heard() from one thread only, the rest from any.

#include <array>
#include <atomic>
#include <cstdint>

namespace ehm::idl {

class Intake {
 public:
  /// A sample of this writer (writer_number, not 0) has been read.
  void heard(std::uint64_t writer) noexcept {
    for (std::size_t i = 0; i < probes; ++i) {
      std::atomic<std::uint64_t>& place = writers_[(writer + i) % writers_.size()];
      const std::uint64_t known = place.load(std::memory_order_relaxed);
      if (known == writer) return;
      if (known != 0) continue;
      place.store(writer, std::memory_order_relaxed);
      return;
    }
  }
  /// Has it been read? With a thousand writers or more, one that has may be forgotten.
  bool has_heard(std::uint64_t writer) const noexcept {
    for (std::size_t i = 0; i < probes; ++i)
      if (writers_[(writer + i) % writers_.size()].load(std::memory_order_relaxed) == writer) return true;
    return false;
  }

  /// A message of so many bytes is not of the topic's type.
  void misfit(std::uint32_t bytes) noexcept {
    bytes_.store(bytes, std::memory_order_relaxed);
    misfits_.fetch_add(1, std::memory_order_release);
  }
  std::uint64_t misfits() const noexcept { return misfits_.load(std::memory_order_acquire); }
  /// Length of the last of them.
  std::uint32_t misfit_bytes() const noexcept { return bytes_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t probes = 8;
  std::array<std::atomic<std::uint64_t>, 2048> writers_{};
  std::atomic<std::uint64_t> misfits_{0};
  std::atomic<std::uint32_t> bytes_{0};
};

}  // namespace ehm::idl
