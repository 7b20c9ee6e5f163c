// SPDX-License-Identifier: Apache-2.0
#pragma once
// The cycle thread's side of checkpoints: resumes an engine at its first sample, and hands over its state every period.
//
// One state a turn at most, so that a fleet's copies are spread over many turns.

#include <cstdint>
#include <optional>

#include "monitor/checkpoint/checkpoint_folder.h"
#include "monitor/checkpoint/checkpoint_writer.h"
#include "monitor/shared/engine_slot.h"

namespace ehm::monitor {

class CheckpointKeeper {
 public:
  /// Both must outlive this. `companions`: of each engine, as `writer` has been told.
  CheckpointKeeper(CheckpointWriter& writer, const ResumeTable& resumable, double period_s, double max_age_s,
                   std::size_t companions);

  /// Before an engine's first sample, which waits in `slot.sample`, is processed. What is to be reported, if there was
  /// a checkpoint. Real-time safe: yes.
  std::optional<Event> resume(EngineSlot& slot) const noexcept;
  /// Takes the slot's state if that is due. `now_ns` is monotonic and the same for all slots of a turn. Real-time safe:
  /// yes.
  void keep(EngineSlot& slot, std::int64_t now_ns) noexcept;
  /// At the stop: takes the slot's state, and waits for room until `limit_ns` (monotonic).
  void keep_last(EngineSlot& slot, std::int64_t limit_ns);
  const CheckpointWriter& writer() const noexcept { return writer_; }

 private:
  bool take(EngineSlot& slot) noexcept;

  CheckpointWriter& writer_;
  const ResumeTable& resumable_;
  std::int64_t period_ns_;
  double max_age_s_;
  std::int64_t turn_ns_ = 0;  ///< of the latest state that was handed over
  CheckpointRequest request_;
};

}  // namespace ehm::monitor
