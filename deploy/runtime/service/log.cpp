// SPDX-License-Identifier: Apache-2.0
#include "deploy/runtime/service/log.h"

#include <spdlog/async.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace ehm::service {

void start_log(const std::string& name) {
  constexpr std::size_t kept_lines = 8192;
  spdlog::init_thread_pool(kept_lines, 1);
  spdlog::set_default_logger(
      std::make_shared<spdlog::async_logger>(name, std::make_shared<spdlog::sinks::stderr_color_sink_mt>(),
                                             spdlog::thread_pool(), spdlog::async_overflow_policy::overrun_oldest));
}

std::uint64_t lost_log_lines() {
  const auto pool = spdlog::thread_pool();
  return pool ? pool->overrun_counter() : 0;
}

}  // namespace ehm::service
