#include "monitor/security_events.h"

#include <chrono>

#include "idl/wire_values.h"

namespace ehm::monitor {

SecurityEvents::SecurityEvents(wire::Participant& participant, std::uint32_t source_id,
                               std::shared_ptr<service::IncidentBox> box)
    : source_id_(source_id),
      events_(participant),
      watch_(participant, std::move(box), [this](const std::string& text, std::uint64_t times) { say(text, times); }) {}

void SecurityEvents::say(const std::string& text, std::uint64_t times) {
  service::log_incident(text, times);
  incidents_ += times;
  HealthEvent event;
  event.engine_id(0);
  event.source_id(source_id_);
  event.kind(static_cast<std::uint32_t>(wire::EventKind::security));
  event.schema(wire::schema_version);
  event.raised(1);
  event.sequence_number(incidents_);
  event.source_time_ns(
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count());
  event.value(static_cast<double>(times));
  event.message() = text.c_str();
  events_.write(event);
}

}  // namespace ehm::monitor
