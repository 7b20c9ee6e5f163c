#pragma once
// One sentence for an event: what happened to which channel, by how much, and against what.

#include <string>

#include "monitor/estimation/linear_model.h"
#include "monitor/judge/events.h"

namespace ehm::monitor {

/// Name of the channel that the event is about; empty where it is about the whole engine.
std::string channel_name(const Event& event, const estimation::LinearModel& model);
std::string event_text(const Event& event, const estimation::LinearModel& model);

}  // namespace ehm::monitor
