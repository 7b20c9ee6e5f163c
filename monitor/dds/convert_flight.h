// SPDX-License-Identifier: Apache-2.0
#pragma once
// A flight as its message: by channel in the design's order. Who publishes adds engine and source. Nothing was seen of
// what is infinite: 0 on the wire.

#include "engine_health.h"
#include "monitor/history/flight_entry.h"

namespace ehm::monitor {

void convert(const Flight& flight, FlightSummary& summary);

}  // namespace ehm::monitor
