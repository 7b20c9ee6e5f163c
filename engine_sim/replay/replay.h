// SPDX-License-Identifier: Apache-2.0
#pragma once
// A recording or a CSV file on the wire again: the same engines, sequence numbers, time stamps and values, in the same
// order, also what was malformed, duplicated or overtaken.

#include <memory>

#include "deploy/runtime/recording/row_source.h"
#include "deploy/runtime/service/stop_signal.h"
#include "engine_sim/scenario/scenario_file.h"

namespace ehm::engine_sim {

/// Waits for readers, then publishes the rows until their end or a stop.
/// @throws idl::DdsError when DDS cannot be set up, files::FileError when the file is damaged,
///         std::runtime_error when under rate max no monitor answers.
void run_replay(const SimConfig& config, recording::RowSource& rows, const service::StopSignal& stop);

}  // namespace ehm::engine_sim
