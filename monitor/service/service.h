// SPDX-License-Identifier: Apache-2.0
#pragma once
// The monitor as a service: which threads there are, and what connects them.
//
//   DDS --> CycleThread (the caller's thread) --> DDS
//               | bounded queues, never waited for
//               v
//           Reporter (logs, events, status) and whatever else is slow, each on a thread of its own
//               | StatusBoard
//               v
//           MetricsEndpoint (HTTP); Watchdog looks at the cycle's turns
//
// @throws idl::DdsError if DDS refuses an entity.

#include "idl/dds/participant.h"
#include "monitor/reload/reloader.h"
#include "monitor/shared/engine_table.h"
#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

/// The participant that the configuration asks for; who takes part adds what shall become of its notices.
idl::ParticipantOptions service_participant(const MonitorConfig& config);

/// Serves until SIGINT or SIGTERM; then drains and tells every engine's subscribers that it stopped in order.
/// SIGHUP reads the configuration again through `source`.
void run_service(const MonitorConfig& config, std::unique_ptr<EngineTable> engines, const ReloadSource& source);

}  // namespace ehm::monitor
