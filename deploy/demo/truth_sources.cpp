// SPDX-License-Identifier: Apache-2.0
#include "deploy/demo/truth_sources.h"

#include <algorithm>

namespace ehm::demo {

const EngineTruth* TruthSources::Source::find(std::uint64_t sequence, std::int64_t source_time_ns) const {
  const auto& candidate = recent[sequence % recent.size()];
  const bool same =
      candidate && candidate->sequence_number() == sequence && candidate->source_time_ns() == source_time_ns;
  return same ? &*candidate : nullptr;
}

TruthSources::Source* TruthSources::source(std::uint64_t participant) {
  const auto known =
      std::find_if(sources_.begin(), sources_.end(), [&](const Source& s) { return s.participant == participant; });
  return known == sources_.end() ? nullptr : &*known;
}

void TruthSources::describe(std::uint64_t participant) {
  if (source(participant)) return;
  std::erase_if(strangers_, [&](const Stranger& s) { return s.first == participant; });
  if (sources_.size() == most_known)
    sources_.erase(
        std::find_if(sources_.begin(), sources_.end(), [this](const Source& s) { return s.participant != followed_; }));
  sources_.emplace_back().participant = participant;
}

void TruthSources::hear(const EngineTruth& truth, std::uint64_t participant) {
  if (Source* s = source(participant)) {
    s->recent[truth.sequence_number() % s->recent.size()] = truth;
    s->last = truth;
    if (participant != followed_) ++s->unused;
    return;
  }
  const auto known =
      std::find_if(strangers_.begin(), strangers_.end(), [&](const Stranger& s) { return s.first == participant; });
  if (known != strangers_.end()) {
    ++known->second;
    return;
  }
  if (strangers_.size() == most_known) {
    forgotten_ += strangers_.front().second;
    strangers_.pop_front();
  }
  strangers_.emplace_back(participant, 1);
}

void TruthSources::follow(std::uint64_t sequence, std::int64_t source_time_ns) {
  for (Source& s : sources_)
    if (s.find(sequence, source_time_ns)) {
      followed_ = s.participant;
      s.unused = 0;
      return;
    }
}

const EngineTruth* TruthSources::find(std::uint64_t sequence, std::int64_t source_time_ns) const {
  for (const Source& s : sources_)
    if (const EngineTruth* truth = s.find(sequence, source_time_ns)) return truth;
  return nullptr;
}

const EngineTruth* TruthSources::last() const {
  for (const Source& s : sources_)
    if (s.participant == followed_ && s.last) return &*s.last;
  return nullptr;
}

std::uint64_t TruthSources::ignored() const {
  std::uint64_t ignored = forgotten_;
  for (const auto& [participant, heard] : strangers_) ignored += heard;
  for (const Source& s : sources_)
    if (followed_ != 0 && s.participant != followed_) ignored += s.unused;
  return ignored;
}

}  // namespace ehm::demo
