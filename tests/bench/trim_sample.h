// SPDX-License-Identifier: Apache-2.0
#pragma once
// Sensor samples of an engine that stays at its design's trim, for benches that need no physics. The last digits move
// from sample to sample, as those of a sensor do: a value that stands still is a stuck channel.

#include <cstdint>
#include <string>

#include "engine_health.h"

namespace ehm::tuner_design {

class TrimSample {
 public:
  /// @throws files::FileError if the design cannot be read.
  explicit TrimSample(const std::string& design_file, std::uint32_t engine_id = 1);

  /// The next sample of this engine; the source's clock moves on by one period.
  const EngineSensors& next(std::int64_t period_ns);
  const EngineSensors& latest() const { return sample_; }
  /// The same engine under another number, from its first sample on.
  TrimSample of_engine(std::uint32_t engine_id) const;

 private:
  EngineSensors trim_, sample_;
};

}  // namespace ehm::tuner_design
