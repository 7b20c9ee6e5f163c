#pragma once
// Rank of redundant monitors under exclusive ownership: who flies stays, who returns stands by.
//
// Each monitor starts with its configured strength. Once only its own estimates are heard for a while it is the
// incumbent and raises its strength by a bonus above all configured ones. A monitor that returns is then weaker than
// the one that took over, and is not heard until that one dies or stops in order. So nothing is handed back, and no
// subscriber sees a sample twice: a stronger writer owns an instance from its first sample on, and by then subscribers
// may have the weaker one's sample of the same number. Only the owner's own change of strength moves nothing.
//
// Runs on a thread of its own. Listens only until it is the incumbent, since a reader of our own estimates costs the
// writer time.

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include "idl/dds/endpoint.h"

namespace ehm::monitor {

inline constexpr std::uint32_t incumbent_bonus = 2'000'000;  // twice the largest dds.ownership_strength

class PeerWatch {
 public:
  /// `source_id` is ours; `become_incumbent` is called once, on the watch's thread, and tells whether it went.
  PeerWatch(wire::Participant& participant, std::uint32_t source_id, std::function<bool()> become_incumbent);
  ~PeerWatch();

 private:
  void run();

  wire::Participant& participant_;
  std::uint32_t source_id_;
  std::function<bool()> become_incumbent_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace ehm::monitor
