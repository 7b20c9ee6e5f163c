// SPDX-License-Identifier: Apache-2.0
#pragma once
// A flight with the names and units of its design's channels, and its margins where there is an engine model. `wear` is
// left at 0: who keeps a baseline fills it in. Errors: none; where the engine model does not reach hot-day take-off at
// the estimate there are no margins. Allocates; some 50 steady points of the engine.

#include "monitor/design/design.h"
#include "monitor/history/flight_entry.h"
#include "monitor/onboard/on_board_model.h"

namespace ehm::monitor {

/// `model`: null where the published estimator has none.
Flight sum_flight(const FlightTotals& totals, const estimation::Learned& learned, const design::Design& design,
                  const onboard::OnBoardModel* model);

}  // namespace ehm::monitor
