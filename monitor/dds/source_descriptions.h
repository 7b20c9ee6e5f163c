#pragma once
// What the sources say of their channels, on EngineDescription beside their samples: names and units, and how they fit
// the design that flies (checks/source_fit.h).
//
// A description travels beside the samples and may come after the first of them. A source whose participant has a
// writer of descriptions is therefore waited for, once, for 50 ms at most: no sample is used before its units are
// known. Sources that describe nothing are not waited for; their units are taken as the design's.
//
// Real-time safe: yes, but for a source's first description, which allocates its place, and the first sample of an
// engine or writer, which takes a lock.

#include <array>
#include <map>
#include <utility>

#include "idl/dds/endpoint.h"
#include "monitor/checks/source_fit.h"

namespace ehm::monitor {

/// One source of one engine.
struct DescribedSource {
  std::array<DescribedChannel, estimation::max_sensors> sensors;
  std::array<DescribedChannel, estimation::max_actuators> actuators;
  std::uint32_t sensor_count = 0, actuator_count = 0;
  bool described = false, waited_for = false;
  const estimation::LinearModel* model = nullptr;  ///< that `fit` is of; null: none yet
  SourceFit fit;
  std::uint32_t told = 0;  ///< misfits that are raised: bit i a sensor, bit max_sensors + i an actuator

  /// Channels that both this source and the model have.
  std::size_t sensors_of(const estimation::LinearModel& m) const noexcept;
  std::size_t actuators_of(const estimation::LinearModel& m) const noexcept;
  /// Fits the source to a model.
  void fit_to(const estimation::LinearModel& m) noexcept;
};

class SourceDescriptions {
 public:
  explicit SourceDescriptions(wire::Participant& participant) : reader_(participant) {}

  eprosima::fastdds::dds::StatusCondition& condition() { return reader_.condition(); }
  /// Takes what has come, and calls `said(engine_id, source_id, source)` for each description of a source; its `fit`
  /// is still of what it said before, and its `model` null.
  template <class Said>
  void take(Said&& said) {
    for (int taken = 0; taken < most_a_turn && reader_.take(incoming_);)
      if (DescribedSource* source = keep(incoming_)) {
        ++taken;
        said(incoming_.engine_id(), incoming_.source_id(), *source);
      }
  }
  /// Null for a source that has described nothing.
  DescribedSource* find(std::uint32_t engine_id, std::uint32_t source_id) noexcept;
  /// Is a description of this source to be waited for at `now_ns` (monotonic)? `participant`: of the sample's writer.
  bool awaited(std::uint32_t engine_id, std::uint32_t source_id, std::uint64_t participant, std::int64_t now_ns);
  /// Models have gone: every fit is made anew.
  void forget_models() noexcept;

 private:
  using Key = std::pair<std::uint32_t, std::uint32_t>;  ///< engine_id, source_id
  DescribedSource* keep(const EngineDescription& description);
  DescribedSource* place(const Key& key);

  static constexpr int most_a_turn = 64;
  wire::Reader<EngineDescription> reader_;
  EngineDescription incoming_;
  std::map<Key, DescribedSource> sources_;
  std::int64_t waiting_since_ns_ = 0;  ///< 0: for nobody
};

}  // namespace ehm::monitor
