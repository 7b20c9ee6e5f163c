// SPDX-License-Identifier: Apache-2.0
#pragma once
// Rate max for a replay: at most `window` samples are without the monitor's answer, over all engines, so that keep-last
// loses nothing. A sample that the recording monitor dropped has no answer and is not waited for. What is not answered
// within a second while a monitor lives is given up: that monitor does not serve the engine, or drops the sample.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <map>

#include "deploy/runtime/numbers/index.h"
#include "idl/dds/endpoint.h"

namespace ehm::engine_sim {

class ReplayAnswers {
 public:
  ReplayAnswers(idl::Participant& participant, std::size_t window) : answers_(participant), window_(window) {
    wait_set_.attach_condition(answers_.condition());
  }

  int monitors() const { return answers_.matched(); }
  /// Samples that were given up so far.
  std::uint64_t unanswered() const { return unanswered_; }

  void sent(std::uint32_t engine_id, std::uint64_t sequence) {
    pending_[engine_id].push_back(sequence);
    ++pending_total_;
  }
  /// Waits until another sample may be sent. False after the time limit: nobody answers any more.
  bool admit(std::chrono::milliseconds limit) {
    const auto start = std::chrono::steady_clock::now();
    for (take_answers(); pending_total_ >= window_; take_answers()) {
      const auto waited = std::chrono::steady_clock::now() - start;
      if (waited >= limit) return false;
      if (waited >= give_up && monitors() > 0) {
        unanswered_ += pending_total_;
        pending_.clear();
        pending_total_ = 0;
        break;
      }
      wait_set_.wait(triggered_, eprosima::fastrtps::Duration_t(0.05L));
    }
    return true;
  }

 private:
  void take_answers() {
    EngineResiduals answer;
    while (answers_.take(answer)) {
      auto& sequences = pending_[answer.engine_id()];
      const auto found = std::find(sequences.begin(), sequences.end(), answer.sequence_number());
      if (found == sequences.end()) continue;  // another monitor's, or given up
      pending_total_ -= as_size(found - sequences.begin()) + 1;
      sequences.erase(sequences.begin(), found + 1);
    }
  }

  static constexpr std::chrono::milliseconds give_up{1000};
  idl::Reader<EngineResiduals> answers_;  // every processed sample has them, also where an estimate is withheld
  std::size_t window_, pending_total_ = 0;
  std::map<std::uint32_t, std::deque<std::uint64_t>> pending_;
  std::uint64_t unanswered_ = 0;
  eprosima::fastdds::dds::WaitSet wait_set_;
  eprosima::fastdds::dds::ConditionSeq triggered_;
};

}  // namespace ehm::engine_sim
