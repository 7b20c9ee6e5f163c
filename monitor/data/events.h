// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the cycle has to say beside the estimates: conditions that began or ended. Fixed capacity, no text: whoever
// publishes them makes the message (monitor/service/event_text.h).

#include <array>
#include <cstddef>
#include <cstdint>

#include "idl/wire_values.h"

namespace ehm::monitor {

struct Event {
  /// Details of an event that ends a condition though nothing has become better: another design flies from now on, or
  /// the filter starts anew.
  static constexpr std::uint32_t design_exchanged = 0x8000'0000u, reassessed = 0x8000'0001u;

  idl::EventKind kind{};
  std::uint32_t channel = 0;
  bool raised = false;
  double value = 0.0;
  double threshold = 0.0;
  std::uint32_t detail = 0;  ///< by kind; sensor_fault: idl::reject_reason bits; condition_fault: 0 moved, 1 lost
  double age_s = 0.0;        ///< how long before this sample it began; 0 where nobody knows
};

/// Events of one cycle. What does not fit is counted, never silently dropped.
class EventList {
 public:
  void push(const Event& event) noexcept {
    raised_total_ += event.raised;
    if (size_ < events_.size())
      events_[size_++] = event;
    else
      ++overflow_;
  }
  void clear() noexcept { size_ = 0; }
  const Event* begin() const noexcept { return events_.data(); }
  const Event* end() const noexcept { return events_.data() + size_; }
  std::size_t size() const noexcept { return size_; }
  std::uint64_t overflow() const noexcept { return overflow_; }
  /// Conditions that began, since the list was made.
  std::uint64_t raised_total() const noexcept { return raised_total_; }

 private:
  // Every sensor, health and auxiliary channel may change state in one cycle, and some single conditions.
  std::array<Event, 64> events_{};
  std::size_t size_ = 0;
  std::uint64_t overflow_ = 0, raised_total_ = 0;
};

/// One condition with two states; says when it changes.
class Condition {
 public:
  bool raised() const noexcept { return raised_; }
  /// Pushes `event` if `now` differs from the present state.
  void set(bool now, Event event, EventList& events) noexcept {
    if (now == raised_) return;
    raised_ = now;
    event.raised = now;
    events.push(event);
  }
  /// Ends it with the design that it is of.
  void end_with_design(idl::EventKind kind, std::uint32_t channel, EventList& events) noexcept {
    set(false, {.kind = kind, .channel = channel, .detail = Event::design_exchanged}, events);
  }
  /// Ends it with the filter that has found it.
  void reassess(idl::EventKind kind, std::uint32_t channel, EventList& events) noexcept {
    set(false, {.kind = kind, .channel = channel, .detail = Event::reassessed}, events);
  }

 private:
  bool raised_ = false;
};

}  // namespace ehm::monitor
