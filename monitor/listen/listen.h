// SPDX-License-Identifier: Apache-2.0
#pragma once
// monitor --listen: verifies the wiring of a source of EngineSensors without estimating. Subscribes as the service
// does, so that what is found here (QoS, domain, partition) is what the service would meet, and reports rates, losses,
// times and every channel against the design.
//
// @throws idl::DdsError if DDS refuses an entity; std::runtime_error if a design has no steady state.

#include <CLI/App.hpp>
#include <iosfwd>

#include "monitor/shared/engine_table.h"
#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

struct ListenOptions {
  bool wanted = false;
  double seconds = 10.0;  ///< 0: until SIGINT
  bool json = false;
};

/// --listen, --seconds, --json.
void declare(CLI::App& app, ListenOptions& options);

/// Writes the report to `out`. True if every source is wired as the monitor needs it, and there is one.
bool listen(const MonitorConfig& config, const EngineTable& engines, const ListenOptions& options, std::ostream& out);

}  // namespace ehm::monitor
