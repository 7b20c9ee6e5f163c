// SPDX-License-Identifier: Apache-2.0
#pragma once
// Writes checkpoints on a thread of its own. The cycle thread hands over plain copies through a bounded queue; when
// that is full the checkpoint is due again at the next turn, so a slow disk makes checkpoints rarer and nothing else.
// A disk that is full, read-only or away costs checkpoints only: an event tells when it begins and ends, each
// checkpoint that is due tries again, and the folder is made anew if it has gone.

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>

#include "monitor/cycle/cycle_state.h"
#include "monitor/realtime/spsc_queue.h"
#include "monitor/shared/notice_board.h"

namespace ehm::monitor {

/// What is copied on the cycle thread. A design's hash has 64 characters.
struct CheckpointRequest {
  std::uint32_t engine_id = 0;
  std::array<char, 64> design_hash{};
  std::int64_t wall_time_ns = 0;
  CycleState state;
};

class CheckpointWriter {
 public:
  /// `notices`: hears when writing begins to fail, and when it works again. `companions`: of each engine, so that what
  /// is queued has room for their states.
  CheckpointWriter(std::string folder, NoticeBoard& notices, std::size_t companions);
  /// Writes what is queued for 0.4 s at most, then ends the thread; says how many were left.
  ~CheckpointWriter();

  /// For the cycle thread. Real-time safe: yes, both.
  bool has_room() const noexcept { return queue_->has_room(); }
  void push(const CheckpointRequest& request) noexcept { queue_->push(request); }
  std::uint64_t written() const noexcept { return written_.load(std::memory_order_relaxed); }
  std::uint64_t failed() const noexcept { return failed_.load(std::memory_order_relaxed); }

 private:
  void run();
  void write(const CheckpointRequest& request);
  void tell(bool failing, const std::string& why);

  static constexpr std::size_t queue_length = 32;
  std::string folder_;
  NoticeBoard& notices_;
  bool failing_ = false;
  std::unique_ptr<SpscQueue<CheckpointRequest, queue_length>> queue_;
  std::atomic<std::uint64_t> written_{0}, failed_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
