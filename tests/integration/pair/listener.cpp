// SPDX-License-Identifier: Apache-2.0
#include "tests/integration/pair/listener.h"

namespace ehm::test {

namespace {

template <class T>
void take(idl::Reader<T>& reader, std::vector<T>& into) {
  T sample;
  while (reader.take(sample)) into.push_back(sample);
}

}  // namespace

Listener::Listener(idl::Participant& participant)
    : sensors_(participant),
      health_(participant),
      auxiliary_(participant),
      residuals_(participant),
      truth_(participant),
      descriptions_(participant),
      status_(participant),
      events_(participant) {
  wait_set_.attach_condition(sensors_.condition());
  wait_set_.attach_condition(health_.condition());
  wait_set_.attach_condition(status_.condition());
  wait_set_.attach_condition(events_.condition());
}

void Listener::take_all() {
  take(descriptions_, descriptions);
  take(sensors_, sensors);
  EngineTruth t;
  while (truth_.take(t)) truth[t.sequence_number()] = t;
  take(health_, health);
  take(auxiliary_, auxiliary);
  take(residuals_, residuals);
  take(status_, status);
  take(events_, events);
}

bool Listener::await(const std::function<bool()>& condition, std::chrono::seconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  eprosima::fastdds::dds::ConditionSeq triggered;
  for (;;) {
    take_all();
    if (condition()) return true;
    if (std::chrono::steady_clock::now() >= deadline) return false;
    wait_set_.wait(triggered, eprosima::fastrtps::Duration_t(0.02L));
  }
}

const HealthEvent* Listener::find_event(idl::EventKind kind, bool raised) const {
  for (const auto& e : events)
    if (e.kind() == static_cast<std::uint32_t>(kind) && (e.raised() != 0) == raised) return &e;
  return nullptr;
}

}  // namespace ehm::test
