#include "monitor/redundancy/peer_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>

namespace ehm::monitor {

namespace {
using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds poll{10};
// Longer than the lease after which an engine passes to another monitor, and than a participant needs to be found.
constexpr std::chrono::milliseconds alone_for{1000};
}  // namespace

PeerWatch::PeerWatch(wire::Participant& participant, std::uint32_t source_id, std::function<bool()> become_incumbent)
    : participant_(participant),
      source_id_(source_id),
      become_incumbent_(std::move(become_incumbent)),
      thread_([this] { run(); }) {}

PeerWatch::~PeerWatch() {
  stop_.store(true, std::memory_order_relaxed);
  thread_.join();
}

void PeerWatch::run() {
  wire::Reader<EngineHealth> reader(participant_);
  EngineHealth estimate;
  bool heard_us = false;
  Clock::time_point peer_heard = Clock::now();
  while (!stop_.load(std::memory_order_relaxed)) {
    while (reader.take(estimate)) {
      heard_us |= estimate.source_id() == source_id_;
      if (estimate.source_id() != source_id_) {
        heard_us = false;
        peer_heard = Clock::now();
      }
    }
    if (heard_us && Clock::now() - peer_heard > alone_for) {
      if (become_incumbent_())
        spdlog::info("only this monitor is heard: one that returns stands by until this one ends");
      else
        spdlog::warn("the middleware refused a higher ownership strength: a stronger monitor takes over on its return");
      return;
    }
    std::this_thread::sleep_for(poll);
  }
}

}  // namespace ehm::monitor
