// SPDX-License-Identifier: Apache-2.0
#include "monitor/export/metrics_endpoint.h"

#include <spdlog/spdlog.h>

#include "deploy/runtime/service/listen_address.h"
#include "monitor/export/metrics.h"
#include "monitor/realtime/clock.h"

namespace ehm::monitor {

MetricsEndpoint::MetricsEndpoint(const std::string& listen, std::uint32_t source_id, const StatusBoard& board,
                                 const Loops& loops)
    : cycle_(loops.cycle, monotonic_ns()),
      reporter_(loops.reporter, monotonic_ns()),
      status_limit_s_(3.0 * loops.status_period_s + 1.0) {
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
  server_->on_tick([this] {
    cycle_.look(monotonic_ns());
    reporter_.look(monotonic_ns());
  });
  server_->on_get("/metrics", [this, &board, source_id, &expires_s = loops.certificate_expires_s] {
    return service::HttpAnswer{200, metrics_text({board.view(), source_id, cycle_.turns(), ages(), expires_s.load()}),
                               "text/plain; version=0.0.4; charset=utf-8"};
  });
  server_->on_get("/health", [this, &board] { return health_answer(board.view(), ages()); });
  server_->on_get("/ready", [this, &board] { return ready_answer(board.view(), ages()); });
  server_->start();
  spdlog::info("metrics at http://{}:{}/metrics, beside it /health and /ready",
               address.host.find(':') == std::string::npos ? address.host : "[" + address.host + "]", server_->port());
  if (!address.loopback())
    spdlog::warn("metrics.listen is no loopback address: whoever reaches it may read the metrics");
}

Ages MetricsEndpoint::ages() const {
  const std::int64_t now_ns = monotonic_ns();
  return {cycle_.age_s(now_ns), reporter_.age_s(now_ns), now_ns, status_limit_s_};
}

}  // namespace ehm::monitor
