// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the simulator puts on the wire: sensors, truth, and the description of its channels.

#include "engine_sim/simulated_engine.h"
#include "idl/dds/endpoint.h"

namespace ehm::engine_sim {

class SimPublisher {
 public:
  SimPublisher(idl::Participant& participant, std::uint32_t engine_id, std::uint32_t source_id);

  /// Names, units, trim and noise of the channels; once, late joiners get it too.
  void describe(const EngineChannels& channels);
  /// Told with each truth from now on.
  void state_mismatch(std::span<const double> mismatch);
  /// `source_time_ns` stamps the sample; false when the middleware refused it.
  bool publish(const EngineSample& sample, std::int64_t source_time_ns);

  int monitors() const { return sensors_.matched(); }
  /// Waits until what was sent has arrived; false after the time limit.
  bool drain(double seconds) { return sensors_.drain(seconds) && truth_.drain(seconds); }

 private:
  idl::Writer<EngineSensors> sensors_;
  idl::Writer<EngineTruth> truth_;
  idl::Writer<EngineDescription> description_;
  EngineSensors sensors_sample_;
  EngineTruth truth_sample_;
};

}  // namespace ehm::engine_sim
