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

PeerWatch::PeerWatch(wire::Participant& participant, std::uint32_t source_id,
                     std::function<bool(std::uint32_t)> set_strength)
    : participant_(participant),
      source_id_(source_id),
      configured_(participant.options().redundancy.strength),
      set_strength_(std::move(set_strength)),
      fence_(monotonic_ns(), heard_),
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
    while (!stopped() && heard_.load(std::memory_order_relaxed)) std::this_thread::sleep_for(poll);
    if (stopped()) return;
    // A write that the pause caught half done goes out late, and makes us the owner again: as the weakest of all, for
    // as long as we are quiet, that is over at once.
    set(0, "held up for longer than the lease: another monitor may fly on");
    const auto quiet_until = Clock::now() + std::chrono::nanoseconds(WriteFence::quiet_ns);
    while (!stopped() && Clock::now() < quiet_until) std::this_thread::sleep_for(poll);
    if (!stopped()) set(configured_, "stands by");
  }
}

void PeerWatch::listen_until_alone() {
  wire::Reader<EngineHealth> reader(participant_);
  EngineHealth estimate;
  Clock::time_point peer_heard = Clock::now() + discovery - alone_for;
  while (!stopped()) {
    while (reader.take(estimate)) {
      const bool ours = estimate.source_id() == source_id_;
      heard_.store(ours, std::memory_order_relaxed);
      if (!ours) peer_heard = Clock::now();
    }
    if (heard_.load(std::memory_order_relaxed) && Clock::now() - peer_heard > alone_for) return;
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
