#pragma once
// The simulator's loop: wait for readers, then commands -> sample -> publish -> pace, until stopped or flown.

#include "deploy/service/stop_signal.h"
#include "engine_sim/scenario/scenario_file.h"
#include "engine_sim/simulation.h"

namespace ehm::engine {

/// @throws wire::DdsError when DDS cannot be set up, SolveError when the engine cannot run as demanded,
///         std::runtime_error when under rate max the monitor stops answering.
void run(const SimConfig& config, Simulation& simulation, const service::StopSignal& stop);

}  // namespace ehm::engine
