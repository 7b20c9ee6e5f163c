// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rank of redundant monitors under exclusive ownership: who flies stays, who returns stands by.
//
// Each monitor starts with its configured strength. Once only its own estimates are heard for a while it is the
// incumbent, and writes with a bonus above all configured strengths (ranked_writer.h). A monitor that returns is then
// weaker than the one that took over, and is not heard until that one dies or stops in order. So nothing is handed
// back, and no subscriber sees a sample twice: a stronger writer owns an instance from its first sample on, and by then
// subscribers may have the weaker one's sample of the same number. The owner itself may become stronger at any time.
//
// A monitor that was held up for longer than the lease has been passed over: it yields (write_fence.h), that is, goes
// back to its configured strength and is quiet until the other one is the incumbent.
//
// Runs on a thread of its own. Listens only while it is not the incumbent, since a reader of our own estimates costs
// the writer time.

#include <atomic>
#include <cstdint>
#include <thread>

#include "idl/dds/endpoint.h"
#include "monitor/redundancy/write_fence.h"

namespace ehm::monitor {

class PeerWatch {
 public:
  /// `source_id` is ours.
  PeerWatch(idl::Participant& participant, std::uint32_t source_id);
  ~PeerWatch();
  /// For the cycle thread, with the monotonic clock: see write_fence.h. Real-time safe: yes.
  void awake(std::int64_t now_ns) noexcept { fence_.awake(now_ns); }
  bool may_write(std::int64_t now_ns) noexcept { return fence_.may_write(now_ns); }
  bool incumbent() const noexcept { return incumbent_.load(std::memory_order_relaxed); }

 private:
  void run();
  bool stopped() const { return stop_.load(std::memory_order_relaxed); }
  void listen_until_alone();

  idl::Participant& participant_;
  std::uint32_t source_id_;
  std::atomic<bool> heard_{false};  ///< the last estimate heard was ours; of the incumbent, until it yields
  std::atomic<bool> incumbent_{false}, stop_{false};
  WriteFence fence_;
  std::thread thread_;
};

}  // namespace ehm::monitor
