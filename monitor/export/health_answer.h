#pragma once
// What /health and /ready answer.
//
//   /health   is the service alive: its loops turn. 503 if one of them does not: restart it.
//   /ready    do estimates flow: 503 with the engines for which they do not, or while no engine has been heard.
//
// An engine that is switched off is no reason to restart the monitor: /health lists it and answers 200.

#include "deploy/service/http_server.h"
#include "deploy/service/watchdog.h"
#include "monitor/export/status_board.h"

namespace ehm::monitor {

/// The loops that must turn for the service to be of use.
struct Loops {
  const service::TurnCounter& cycle;
  const service::TurnCounter& reporter;
};

/// Looks on for up to 0.2 s until both loops have turned.
service::HttpAnswer health_answer(const FleetView& fleet, const Loops& loops);
service::HttpAnswer ready_answer(const FleetView& fleet);

}  // namespace ehm::monitor
