// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whether a monitor may write at this moment, under exclusive ownership.
//
// Readers take a writer that has been silent for the lease for dead, and belong to the other one from its next sample
// on. So who has been silent for nearly as long must not simply go on:
//   held up     the other one has flown on in the meantime: readers have its samples of the numbers that wait for us,
//               and ours would be seen a second time. Who was heard yields, and is quiet until the other one is the
//               incumbent (peer_watch.h).
//   no input    both were silent, and readers belong to whoever writes first, then to the stronger one, which repeats
//               that sample. So who was heard speaks at once, and who was not lets him.
// Asked before each write and not once a turn, because a pause may fall within a turn, and one turn takes all samples
// of the pause. Between the answer and the datagrams nothing can be called back: that sample is seen late.
//
// Real-time safe: yes. Errors: none.

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "idl/dds/qos.h"

namespace ehm::monitor {

class WriteFence {
 public:
  static constexpr auto lease_ns = static_cast<std::int64_t>(1e9 * idl::redundant_lease_s);
  static constexpr std::int64_t longest_silence_ns = lease_ns / 4 * 3;
  static constexpr std::int64_t longest_nap_ns = 25'000'000;  // a cycle that waits for input wakes up after 15 ms
  static constexpr std::int64_t quiet_ns = 500'000'000;       // who starts or yields: the other one becomes incumbent

  /// `heard`: readers get our estimates, as far as is known; taken back when we yield.
  WriteFence(std::int64_t now_ns, std::atomic<bool>& heard) noexcept
      : heard_(heard), awake_ns_(now_ns), asked_ns_(now_ns), quiet_until_ns_(now_ns + quiet_ns) {}

  /// Call at least once a turn, so that a turn without input is told from one that was held up.
  void awake(std::int64_t now_ns) noexcept {
    nap_ns_ = std::max(nap_ns_, now_ns - awake_ns_);
    awake_ns_ = now_ns;
  }
  /// Call before each write.
  bool may_write(std::int64_t now_ns) noexcept {
    awake(now_ns);
    if (now_ns - asked_ns_ > longest_silence_ns) break_silence(now_ns);
    asked_ns_ = now_ns;
    nap_ns_ = 0;
    return now_ns >= quiet_until_ns_;
  }

 private:
  void break_silence(std::int64_t now_ns) noexcept {
    const bool held_up = nap_ns_ > longest_nap_ns;
    const bool heard =
        held_up ? heard_.exchange(false, std::memory_order_relaxed) : heard_.load(std::memory_order_relaxed);
    if (heard && held_up)
      quiet_until_ns_ = now_ns + quiet_ns;
    else if (!heard && now_ns - quiet_until_ns_ > lease_ns)  // not each time: samples may be further apart than that
      quiet_until_ns_ = now_ns + lease_ns;
  }

  std::atomic<bool>& heard_;
  std::int64_t awake_ns_;  ///< last sign that the cycle runs
  std::int64_t asked_ns_;  ///< last write, or wish to write
  std::int64_t quiet_until_ns_;
  std::int64_t nap_ns_ = 0;  ///< longest time without such a sign since then
};

}  // namespace ehm::monitor
