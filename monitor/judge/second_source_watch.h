#pragma once
// Somebody else sends samples of the engine that a source already serves: said once, and ended once nobody else has for
// `quiet` samples of the source that is followed, or when that one has fallen silent. Real-time safe: yes.

#include "monitor/judge/events.h"
#include "monitor/sample.h"

namespace ehm::monitor {

class SecondSourceWatch {
 public:
  /// A sample that is not listened to, because `followed_id` is the source's.
  void foreign(const Sample& sample, std::uint32_t followed_id, EventList& events) noexcept {
    quiet_ = 0;
    condition_.set(true,
                   {wire::EventKind::second_source, 0, true, static_cast<double>(sample.source_id),
                    static_cast<double>(followed_id), 0},
                   events);
  }
  /// A sample of the source that is followed.
  void followed(EventList& events) noexcept {
    if (condition_.raised() && ++quiet_ >= quiet) end(events);
  }
  /// Nobody is followed any more; whoever sends next will be.
  void end(EventList& events) noexcept {
    condition_.set(false, {wire::EventKind::second_source, 0, false, 0.0, 0.0, 0}, events);
  }

 private:
  static constexpr int quiet = 200;  // 3 s at 15 ms
  Condition condition_;
  int quiet_ = 0;
};

}  // namespace ehm::monitor
