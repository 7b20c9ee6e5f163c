#pragma once
// Rate max: the simulator runs at most `window` samples ahead of the monitor's answers, so that keep-last loses nothing.

#include <chrono>
#include <cstdint>
#include <fastdds/dds/core/condition/WaitSet.hpp>

#include "idl/dds/endpoint.h"

namespace ehm::engine {

class Lockstep {
 public:
  Lockstep(wire::Participant& participant, std::uint32_t engine_id, std::uint64_t window)
      : answers_(participant), engine_id_(engine_id), window_(window) {
    wait_set_.attach_condition(answers_.condition());
  }

  /// Waits until sample `sequence` may be sent. False after the time limit: the monitor no longer answers.
  bool admit(std::uint64_t sequence, std::chrono::milliseconds limit) {
    const auto deadline = std::chrono::steady_clock::now() + limit;
    while (sequence >= answered_ + window_) {
      EngineResiduals answer;
      while (answers_.take(answer))
        if (answer.engine_id() == engine_id_ && answer.sequence_number() + 1 > answered_)
          answered_ = answer.sequence_number() + 1;
      if (sequence < answered_ + window_) break;
      if (std::chrono::steady_clock::now() >= deadline) return false;
      wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(0.05L));
    }
    return true;
  }

 private:
  // Residuals, not estimates: every processed sample has them, also where an estimate is withheld.
  wire::Reader<EngineResiduals> answers_;
  std::uint32_t engine_id_;
  std::uint64_t window_;
  std::uint64_t answered_ = 0;  ///< samples 0 .. answered_ - 1 are answered
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
};

}  // namespace ehm::engine
