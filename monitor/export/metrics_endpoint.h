#pragma once
// GET /metrics, /health and /ready over HTTP, on a thread of its own (deploy/service/http_server.h). An address that is
// taken is said with its remedy, and the monitor flies without: what it estimates matters more than who counts it.

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
