// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the middleware itself notices of the sources, where the configuration asks for it (dds.input_deadline_s,
// dds.input_lease_s): samples later than the deadline, writers that give no sign of life. A reader that asks for either
// hears no writer that does not offer it, so by default it asks for nothing; the monitor's own clock (input_lost,
// STALE) works with every writer.
//
// The callbacks come on middleware threads; settle() on the reporter's. Real-time safe: no.

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>

#include "idl/dds/participant.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

class InputWatch {
 public:
  InputWatch(NoticeBoard& notices, double deadline_s, double lease_s)
      : notices_(notices), deadline_s_(deadline_s), lease_s_(lease_s) {}

  /// What the participant's readers of EngineSensors shall ask for; calls back into this object.
  idl::InputRequest request();
  /// Ends the deadline conditions of engines that have been in time for two periods.
  void settle(std::int64_t now_ns);

  std::uint64_t deadline_misses() const noexcept { return deadline_misses_.load(std::memory_order_relaxed); }
  std::uint64_t liveliness_losses() const noexcept { return liveliness_losses_.load(std::memory_order_relaxed); }

  /// One more period without a sample of this engine, noticed at `now_ns` (monotonic).
  void deadline_missed(std::uint32_t engine_id, std::int64_t now_ns);
  /// So many writers more or fewer are alive, are known and not alive.
  void liveliness_changed(int alive_change, int not_alive_change);

 private:
  NoticeBoard& notices_;
  double deadline_s_, lease_s_;
  std::mutex mutex_;
  std::map<std::uint32_t, std::int64_t> late_;  ///< engines whose deadline is missed: when last
  bool lifeless_ = false;
  std::atomic<std::uint64_t> deadline_misses_{0}, liveliness_losses_{0};
};

}  // namespace ehm::monitor
