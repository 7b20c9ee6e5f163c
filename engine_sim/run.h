// SPDX-License-Identifier: Apache-2.0
#pragma once
// The simulator's loop: wait for readers, then commands -> sample -> publish -> pace, until stopped or flown.

#include "deploy/runtime/service/stop_signal.h"
#include "engine_sim/scenario/scenario_file.h"
#include "engine_sim/simulated_engine.h"

namespace ehm::engine_sim {

/// @throws idl::DdsError when DDS cannot be set up, FlightError when the engine cannot run as demanded,
///         std::runtime_error when under rate max the monitor stops answering.
void run(const SimConfig& config, SimulatedEngine& engine, const service::StopSignal& stop);

}  // namespace ehm::engine_sim
