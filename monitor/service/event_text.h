// SPDX-License-Identifier: Apache-2.0
#pragma once
// One sentence for an event: what happened to which channel, by how much, and against what.

#include <string>

#include "engine_sim/linear_model/linear_model.h"
#include "monitor/data/events.h"

namespace ehm::monitor {

/// Name of the channel that the event is about; empty where it is about the whole engine.
std::string channel_name(const Event& event, const linear_model::LinearModel& model);
std::string event_text(const Event& event, const linear_model::LinearModel& model);

}  // namespace ehm::monitor
