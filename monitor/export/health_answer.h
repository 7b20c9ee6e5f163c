// SPDX-License-Identifier: Apache-2.0
#pragma once
// What /health and /ready answer.
//
//   /health   is the service alive: its loops turn. 503 if one of them has not for 0.25 s: restart it.
//   /ready    do estimates flow: 503 with the engines for which they do not, while no engine has been heard, or where
//             what is known is old, since a loop has stalled.
//
// Both carry the age of what they tell. An engine that is switched off is no reason to restart the monitor: /health
// lists it and answers 200.

#include "deploy/runtime/service/http_server.h"
#include "monitor/export/loop_watch.h"
#include "monitor/export/status_board.h"

namespace ehm::monitor {

service::HttpAnswer health_answer(const FleetView& fleet, const Ages& ages);
service::HttpAnswer ready_answer(const FleetView& fleet, const Ages& ages);

}  // namespace ehm::monitor
