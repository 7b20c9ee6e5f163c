#include "monitor/export/metrics_endpoint.h"

#include <spdlog/spdlog.h>

#include "deploy/service/listen_address.h"
#include "monitor/export/metrics.h"

namespace ehm::monitor {

MetricsEndpoint::MetricsEndpoint(const std::string& listen, std::uint32_t source_id, const StatusBoard& board,
                                 const Loops& loops) {
  if (listen.empty()) return;
  const service::ListenAddress address = service::parse_listen_address(listen);
  try {
    server_.emplace(address);
  } catch (const std::runtime_error& e) {
    spdlog::warn(
        "no metrics: {} cannot be listened on ({}); the monitor runs without. Give each monitor of a host its own "
        "address: metrics.listen (--metrics-listen 127.0.0.1:PORT), or \"\" for none",
        listen, e.what());
    return;
  }
  server_->on_get("/metrics", [&board, loops, source_id] {
    return service::HttpAnswer{200, metrics_text({board.view(), source_id, loops.cycle.turns()}),
                               "text/plain; version=0.0.4; charset=utf-8"};
  });
  server_->on_get("/health", [&board, loops] { return health_answer(board.view(), loops); });
  server_->on_get("/ready", [&board] { return ready_answer(board.view()); });
  server_->start();
  spdlog::info("metrics at http://{}:{}/metrics, beside it /health and /ready",
               address.host.find(':') == std::string::npos ? address.host : "[" + address.host + "]", server_->port());
  if (!address.loopback())
    spdlog::warn("metrics.listen is no loopback address: whoever reaches it may read the metrics");
}

}  // namespace ehm::monitor
