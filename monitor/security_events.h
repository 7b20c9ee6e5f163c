#pragma once
// Who was kept out of a secured domain, as HealthEvent of engine 0: the service's own, not an engine's.

#include "deploy/service/security_watch.h"
#include "idl/dds/endpoint.h"

namespace ehm::monitor {

class SecurityEvents {
 public:
  SecurityEvents(wire::Participant& participant, std::uint32_t source_id, std::shared_ptr<service::IncidentBox> box);

 private:
  void say(const std::string& text, std::uint64_t times);

  std::uint32_t source_id_;
  std::uint64_t incidents_ = 0;
  wire::Writer<HealthEvent> events_;
  service::SecurityWatch watch_;  // last: its thread writes events
};

}  // namespace ehm::monitor
