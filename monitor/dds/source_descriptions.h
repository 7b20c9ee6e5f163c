// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the sources say of their channels, on EngineDescription beside their samples: names and units, and how they fit
// the design that flies (checks/source_fit.h).
//
// A description travels beside the samples and may come after the first of them. A source whose participant has a
// writer of descriptions is therefore waited for, once, for 50 ms at most (waiting_room.h): no sample is used before
// its units are known. Sources that describe nothing are not waited for; their units are taken as the design's. Only
// the participant that sends the samples describes them: what others say under the same source_id is not heard.
//
// Real-time safe: yes, but for a source's first description, which allocates its place, and the first sample of an
// engine or writer, which takes a lock.

#include <array>
#include <compare>
#include <map>

#include "idl/dds/endpoint.h"
#include "monitor/checks/source_fit.h"

namespace ehm::monitor {

/// A source of one engine.
struct SourceKey {
  std::uint32_t engine_id = 0, source_id = 0;
  std::uint64_t participant = 0;  ///< its number (idl/dds/qos.h)
  friend auto operator<=>(const SourceKey&, const SourceKey&) = default;
};

/// What it has said.
struct DescribedSource {
  std::array<DescribedChannel, estimation::max_sensors> sensors;
  std::array<DescribedChannel, estimation::max_actuators> actuators;
  std::uint32_t sensor_count = 0, actuator_count = 0;
  DescribedChannel engine_type;  ///< its name; empty: not said
  bool described = false, waited_for = false;
  const linear_model::LinearModel* model = nullptr;  ///< that `fit` is of; null: none yet
  SourceFit fit;
  std::uint32_t told = 0;  ///< misfits that are raised: bit i is that of SourceChannel::channel (cycle_report.h)

  /// Channels that both this source and the model have.
  std::size_t sensors_of(const linear_model::LinearModel& m) const noexcept;
  std::size_t actuators_of(const linear_model::LinearModel& m) const noexcept;
  /// Its engine is of another type than the model's, by name; where one of them says none, nobody can tell.
  bool other_engine(const linear_model::LinearModel& m) const noexcept;
  /// Fits the source to a model.
  void fit_to(const linear_model::LinearModel& m) noexcept;
};

class SourceDescriptions {
 public:
  explicit SourceDescriptions(idl::Participant& participant) : reader_(participant) {}

  eprosima::fastdds::dds::StatusCondition& condition() { return reader_.condition(); }
  /// Takes what has come, and calls `said(key, source)` for each description of a source; its `fit` is still of what it
  /// said before, and its `model` null.
  template <class Said>
  void take(Said&& said) {
    for (int taken = 0; taken < most_a_turn && reader_.take(incoming_);)
      if (DescribedSource* source = keep(incoming_)) {
        ++taken;
        said(SourceKey{incoming_.engine_id(), incoming_.source_id(), reader_.participant()}, *source);
      }
  }
  /// Null for a source that has described nothing.
  DescribedSource* find(const SourceKey& key) noexcept;
  /// Is a description of this source still to be waited for, by a sample that waits since `since_ns` (monotonic)?
  bool awaited(const SourceKey& key, std::int64_t since_ns, std::int64_t now_ns);
  /// Models have gone: every fit is made anew.
  void forget_models() noexcept;

 private:
  DescribedSource* keep(const EngineDescription& description);
  DescribedSource* place(const SourceKey& key);

  static constexpr int most_a_turn = 64;
  idl::Reader<EngineDescription> reader_;
  EngineDescription incoming_;
  std::map<SourceKey, DescribedSource> sources_;
};

}  // namespace ehm::monitor
