// SPDX-License-Identifier: Apache-2.0
#pragma once
// Samples that are sent before anybody has matched are gone: a flight or a replay waits here first.

#include <spdlog/spdlog.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "deploy/runtime/service/stop_signal.h"

namespace ehm::engine_sim {

/// Until `ready()`, or a stop is requested; `wanted` readers of EngineSensors are what it waits for.
template <class Ready>
void wait_for_readers(std::int64_t wanted, Ready ready, const service::StopSignal& stop) {
  constexpr std::chrono::milliseconds match_poll{10};
  // Matching is not symmetric: a reader that we know may learn of us an announcement later. Samples sent in between
  // arrive, but late.
  constexpr std::chrono::milliseconds match_settling{300};
  if (!ready()) spdlog::info("waiting for {} reader(s) of EngineSensors", wanted);
  while (!ready() && !stop.requested()) std::this_thread::sleep_for(match_poll);
  if (wanted > 0 && !stop.requested()) std::this_thread::sleep_for(match_settling);
}

/// After the process was held up for so long that others have dropped it (idl/dds/hold_watch.h): `join()` makes the
/// participant anew, and as many readers as before, which `readers()` counts, are waited for, two seconds at most.
template <class Readers, class Join>
void join_anew(double held_up_s, Readers readers, Join join, const service::StopSignal& stop) {
  spdlog::warn(
      "held up for {:.1f} s (stopped, or the machine suspended): other participants have dropped us, joining DDS anew",
      held_up_s);
  const int before = readers();
  join();
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(2);
  wait_for_readers(
      before, [&] { return readers() >= before || std::chrono::steady_clock::now() > limit; }, stop);
}

}  // namespace ehm::engine_sim
