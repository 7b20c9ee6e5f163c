// SPDX-License-Identifier: Apache-2.0
#pragma once
// A new engine table on its way from the reloader to the cycle thread, and the old one back: two pointers, no lock.

#include <atomic>
#include <cstdint>

#include "monitor/shared/engine_table.h"

namespace ehm::monitor {

struct TableExchange {
  std::atomic<EngineTable*> next{nullptr};     ///< set by the reloader, taken at a cycle's boundary
  std::atomic<EngineTable*> retired{nullptr};  ///< set by the cycle thread once `next` flies
  std::atomic<std::uint64_t> reloads{0}, refused{0};
};

}  // namespace ehm::monitor
