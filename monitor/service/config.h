// SPDX-License-Identifier: Apache-2.0
#pragma once
// Everything that configures the monitor, through the one schema.
//
// @throws config::ConfigError with file, line, key, value, allowed range.

#include "deploy/runtime/config/schema.h"
#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

/// Declares every key of `config`; load the schema, then call finish_config.
void declare(config::Schema& schema, MonitorConfig& config);
/// Checks what no single key can tell: some design is named, no engine twice.
void finish_config(const MonitorConfig& config);

}  // namespace ehm::monitor
