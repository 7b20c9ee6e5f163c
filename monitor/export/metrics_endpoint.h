// SPDX-License-Identifier: Apache-2.0
#pragma once
// GET /metrics, /health and /ready over HTTP, on a thread of its own (http_server.h). An address that is taken is said
// with its remedy, and the monitor flies without: what it estimates matters more than who counts it.

#include <atomic>
#include <cstdint>
#include <optional>

#include "monitor/export/health_answer.h"
#include "monitor/export/status_board.h"

namespace ehm::monitor {

class MetricsEndpoint {
 public:
  /// The loops that must turn for the service to be of use.
  struct Loops {
    const service::TurnCounter& cycle;
    const service::TurnCounter& reporter;
    double status_period_s;
    const std::atomic<std::int64_t>& certificate_expires_s;  ///< since 1970; 0 without security
  };
  /// `listen`: key metrics.listen, checked by finish_config; empty: no endpoint. All else must outlive this.
  MetricsEndpoint(const std::string& listen, std::uint32_t source_id, const StatusBoard& board, const Loops& loops);

 private:
  Ages ages() const;

  LoopWatch cycle_, reporter_;  // of the server's thread
  double status_limit_s_;
  std::optional<service::HttpServer> server_;
};

}  // namespace ehm::monitor
