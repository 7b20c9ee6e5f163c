// SPDX-License-Identifier: Apache-2.0
#pragma once
// The very cycle without DDS: rows of a recording or a CSV file in, a recording with estimates out.
//
// The same samples in the same order, with the same markers between them, give the same estimates to the bit as they
// gave online. Where the input holds estimates of the same design, they are compared, and the result is printed.
//
// @throws files::FileError, config::ConfigError for what is wrong with the files or does not fit the design.

#include "monitor/shared/engine_table.h"
#include "monitor/shared/monitor_config.h"

namespace ehm::monitor {

/// Before the engines are made: the estimator that the recording published is published again, unless the configuration
/// has `named` one; then a warning says which was recorded. A recording that does not state it changes nothing.
void choose_offline_estimator(MonitorConfig& config, bool named);
/// With offline.all_estimators, before the engines are made: every estimator but the published one becomes a shadow; one
/// that a design has not what it needs for is left out, and said.
void choose_all_estimators(MonitorConfig& config);
/// Until the input's end, SIGINT or SIGTERM.
void run_offline(const MonitorConfig& config, EngineTable& engines);

}  // namespace ehm::monitor
