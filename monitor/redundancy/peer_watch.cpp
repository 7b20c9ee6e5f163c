#include "monitor/redundancy/peer_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>

namespace ehm::monitor {

namespace {
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll{10};
constexpr std::chrono::milliseconds discovery{1000};  // two announcements: after that a peer would have been heard
// Longer than the lease after which an engine passes to another monitor, shorter than a restart.
constexpr std::chrono::milliseconds alone_for{250};
}  // namespace

PeerWatch::PeerWatch(wire::Participant& participant, std::uint32_t source_id,
                     std::function<bool(std::uint32_t)> set_strength)
    : participant_(participant),
      source_id_(source_id),
      configured_(participant.options().redundancy.strength),
      set_strength_(std::move(set_strength)),
      thread_([this] { run(); }) {}

PeerWatch::~PeerWatch() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void PeerWatch::run() {
  while (!stopped()) {
    try {
      listen_until_alone();
    } catch (const wire::DdsError& e) {
      spdlog::error("this monitor may not hear its partner, and keeps its configured strength: {}", e.what());
      return;
    }
    if (stopped()) return;
    set(configured_ + incumbent_bonus, "only this monitor is heard: one that returns stands by until this one ends");
    incumbent_.store(true, std::memory_order_relaxed);
    while (!stopped() && incumbent_.load(std::memory_order_relaxed)) std::this_thread::sleep_for(poll);
    if (!stopped()) set(configured_, "held up for longer than the lease: another monitor may fly on");
  }
}

void PeerWatch::listen_until_alone() {
  wire::Reader<EngineHealth> reader(participant_);
  EngineHealth estimate;
  bool heard_us = false;
  Clock::time_point peer_heard = Clock::now() + discovery - alone_for;
  while (!stopped()) {
    while (reader.take(estimate)) {
      heard_us = estimate.source_id() == source_id_;
      if (!heard_us) peer_heard = Clock::now();
    }
    if (heard_us && Clock::now() - peer_heard > alone_for) return;
    std::this_thread::sleep_for(poll);
  }
}

void PeerWatch::set(std::uint32_t strength, const char* why) {
  if (set_strength_(strength))
    spdlog::info("{}", why);
  else
    spdlog::warn("the middleware refused ownership strength {}: a monitor that returns may take over", strength);
}

}  // namespace ehm::monitor
