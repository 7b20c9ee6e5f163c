// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rate max: the simulator runs at most `window` samples ahead of the monitor's answers, so that keep-last loses
// nothing. A window that is never answered (a monitor died and came back, samples were refused) is given up after a
// second while somebody still answers: the monitor counts what it lost.

#include <chrono>
#include <cstdint>
#include <fastdds/dds/core/condition/WaitSet.hpp>

#include "idl/dds/endpoint.h"

namespace ehm::engine_sim {

class Lockstep {
 public:
  Lockstep(idl::Participant& participant, std::uint32_t engine_id, std::uint64_t window)
      : answers_(participant), engine_id_(engine_id), window_(window) {
    wait_set_.attach_condition(answers_.condition());
  }

  /// Monitors that answer at present.
  int monitors() const { return answers_.matched(); }

  /// Waits until sample `sequence` may be sent. False after the time limit: nobody answers any more.
  bool admit(std::uint64_t sequence, std::chrono::milliseconds limit) {
    const auto start = std::chrono::steady_clock::now();
    while (sequence >= answered_ + window_) {
      EngineResiduals answer;
      while (answers_.take(answer))
        if (answer.engine_id() == engine_id_ && answer.sequence_number() + 1 > answered_)
          answered_ = answer.sequence_number() + 1;
      if (sequence < answered_ + window_) break;
      const auto waited = std::chrono::steady_clock::now() - start;
      if (waited >= limit) return false;
      if (waited >= give_up_ && monitors() > 0) {
        answered_ = sequence;
        break;
      }
      wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(0.05L));
    }
    return true;
  }

 private:
  // Residuals, not estimates: every processed sample has them, also where an estimate is withheld.
  idl::Reader<EngineResiduals> answers_;
  std::uint32_t engine_id_;
  std::uint64_t window_;
  static constexpr std::chrono::milliseconds give_up_{1000};
  std::uint64_t answered_ = 0;  ///< samples 0 .. answered_ - 1 are answered
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
};

}  // namespace ehm::engine_sim
