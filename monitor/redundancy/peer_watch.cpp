// SPDX-License-Identifier: Apache-2.0
#include "monitor/redundancy/peer_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>

#include "monitor/realtime/clock.h"

namespace ehm::monitor {

namespace {
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll{10};
constexpr std::chrono::milliseconds discovery{1000};  // two announcements: after that a peer would have been heard
// Longer than the lease after which an engine passes to another monitor, shorter than a restart.
constexpr std::chrono::milliseconds alone_for{250};
}  // namespace

PeerWatch::PeerWatch(idl::Participant& participant, std::uint32_t source_id)
    : participant_(participant), source_id_(source_id), fence_(monotonic_ns(), heard_), thread_([this] { run(); }) {}

PeerWatch::~PeerWatch() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void PeerWatch::run() {
  while (!stopped()) {
    try {
      listen_until_alone();
    } catch (const idl::DdsError& e) {
      spdlog::error("this monitor may not hear its partner, and keeps its configured strength: {}", e.what());
      return;
    }
    if (stopped()) return;
    spdlog::info("only this monitor, {}, is heard: one that returns stands by until this one ends", source_id_);
    incumbent_.store(true, std::memory_order_relaxed);
    while (!stopped() && heard_.load(std::memory_order_relaxed)) std::this_thread::sleep_for(poll);
    if (stopped()) return;  // still as the incumbent, whose last word is the release of its engines
    incumbent_.store(false, std::memory_order_relaxed);
    spdlog::warn("this monitor, {}, was held up for longer than the lease: another one may fly on", source_id_);
  }
}

void PeerWatch::listen_until_alone() {
  idl::Reader<EngineHealth> reader(participant_);
  EngineHealth estimate;
  Clock::time_point peer_heard = Clock::now() + discovery - alone_for;
  while (!stopped()) {
    while (reader.take(estimate)) {
      const bool ours = reader.from_this_participant();
      heard_.store(ours, std::memory_order_relaxed);
      if (!ours) peer_heard = Clock::now();
    }
    if (heard_.load(std::memory_order_relaxed) && Clock::now() - peer_heard > alone_for) return;
    std::this_thread::sleep_for(poll);
  }
}

}  // namespace ehm::monitor
