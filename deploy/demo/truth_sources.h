// SPDX-License-Identifier: Apache-2.0
#pragma once
// Whose EngineTruth counts: that of the engine's own source, whose samples the monitor follows.
//
// A viewer of a secured domain may not read EngineSensors. The source is therefore known by what a viewer may read: its
// participant describes the engine as its source (EngineDescription, role source), and its truth bears number and time
// stamp of the samples that the estimates belong to. Of several such participants the one that described first counts.
// The truth of all others is ignored and counted.

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "engine_health.h"

namespace ehm::demo {

class TruthSources {
 public:
  /// `participant` (Reader::participant) describes the engine as its source.
  void describe(std::uint64_t participant);
  void hear(const EngineTruth& truth, std::uint64_t participant);
  /// An estimate of this sample has come: who sent its truth is followed from now on.
  void follow(std::uint64_t sequence, std::int64_t source_time_ns);

  /// Truth of a sample of the last second; nullptr if there is none.
  const EngineTruth* find(std::uint64_t sequence, std::int64_t source_time_ns) const;
  /// The last one of the source that is followed; nullptr while nobody is.
  const EngineTruth* last() const;
  /// Has anybody described the engine as its source?
  bool described() const { return !sources_.empty(); }
  /// Truth of participants that are not the engine's source.
  std::uint64_t ignored() const;

 private:
  // Truth waits here for its estimate: a second of samples, by sequence number modulo the size.
  struct Source {
    std::uint64_t participant = 0;
    std::uint64_t unused = 0;  ///< truth of it while another was followed
    std::array<std::optional<EngineTruth>, 64> recent;
    std::optional<EngineTruth> last;
    const EngineTruth* find(std::uint64_t sequence, std::int64_t source_time_ns) const;
  };
  using Stranger = std::pair<std::uint64_t, std::uint64_t>;  ///< participant, truth of it

  static constexpr std::size_t most_known = 8;  ///< sources, and strangers: whoever comes and goes fills no memory
  Source* source(std::uint64_t participant);
  std::deque<Source> sources_;  ///< as they described
  std::deque<Stranger> strangers_;
  std::uint64_t forgotten_ = 0;  ///< truth of strangers that were let go
  std::uint64_t followed_ = 0;   ///< participant; 0: nobody yet
};

}  // namespace ehm::demo
