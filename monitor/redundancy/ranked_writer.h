// SPDX-License-Identifier: Apache-2.0
#pragma once
// The writer of one topic of estimates; under exclusive ownership two DDS writers, one for each rank (peer_watch.h).
//
// Two, because the strength of one cannot be changed for everybody: with DDS Security, readers of Fast DDS 2.9.1 keep
// the strength that they saw when they matched. And so a rank holds from the very sample on that is written with it.
//
// What nobody listens to is not written: streams are volatile, so that no reader would ever get it.
//
// Real-time safe: as idl::Writer. Must be destroyed before its Participant.

#include <cstdint>
#include <optional>
#include <string>

#include "idl/dds/endpoint.h"

namespace ehm::monitor {

inline constexpr std::uint32_t incumbent_bonus = 2'000'000;  // twice the largest dds.ownership_strength

template <class T>
class RankedWriter {
 public:
  /// `estimator` as for an idl::Writer.
  explicit RankedWriter(idl::Participant& participant, const std::string& estimator = "")
      : configured_(participant, 0, estimator) {
    if (participant.options().redundancy.exclusive) incumbent_.emplace(participant, incumbent_bonus, estimator);
  }
  static_assert(idl::Topic<T>::delivery == idl::Delivery::stream, "what is kept for who joins late is always written");

  /// False when the middleware refused the sample.
  bool write(const T& sample, bool as_incumbent) { return !heard() || ranked(as_incumbent).write(sample); }
  void release(const T& key, bool as_incumbent) {
    if (heard()) ranked(as_incumbent).release(key);
  }
  /// Waits until all readers have what was written last; false after the time limit.
  bool drain(double seconds) { return configured_.drain(seconds) && (!incumbent_ || incumbent_->drain(seconds)); }

 private:
  bool heard() const { return configured_.matched() > 0 || (incumbent_ && incumbent_->matched() > 0); }
  idl::Writer<T>& ranked(bool as_incumbent) { return as_incumbent && incumbent_ ? *incumbent_ : configured_; }

  idl::Writer<T> configured_;
  std::optional<idl::Writer<T>> incumbent_;
};

}  // namespace ehm::monitor
