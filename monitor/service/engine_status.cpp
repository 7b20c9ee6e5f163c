// SPDX-License-Identifier: Apache-2.0
#include "monitor/service/engine_status.h"

namespace ehm::monitor {

using idl::StatusLevel;

StatusLevel level_of(const EngineSlot& slot) noexcept {
  namespace flag = idl::estimate_flag;
  if (slot.cycle.stale() || slot.received_ns == 0) return StatusLevel::stale;
  const CycleResult& result = slot.cycle.result();
  if (!result.estimates || slot.cycle.intake().sequence_stands()) return StatusLevel::error;
  const CycleCounters &now = slot.cycle.counters(), &before = slot.status_counters;
  const bool troubled = now.lost != before.lost || now.malformed != before.malformed ||
                        now.reordered != before.reordered || now.foreign != before.foreign ||
                        slot.cycle.intake().order_troubled() || slot.resets.raised();
  const bool restricted = (result.flags & (flag::degraded | flag::shifted | flag::implausible | flag::fallback)) != 0 ||
                          slot.cycle.detection().doubted();
  return troubled || restricted ? StatusLevel::warn : StatusLevel::ok;
}

MonitorStatus make_status(const EngineSlot& slot, StatusLevel level, std::int64_t now_ns, std::int64_t start_ns) {
  const CycleCounters& c = slot.cycle.counters();
  const double since_s = 1e-9 * static_cast<double>(now_ns - slot.rate_ns);
  MonitorStatus s;
  s.engine_id(slot.engine_id);
  s.schema(idl::schema_version);
  s.level(static_cast<std::uint32_t>(level));
  s.last_sequence(slot.last_sequence);
  s.samples_received(c.received);
  s.samples_processed(c.processed);
  s.samples_lost(c.lost);
  s.samples_duplicated(c.duplicated);
  s.samples_reordered(c.reordered);
  s.samples_foreign(c.foreign);
  s.samples_malformed(c.malformed);
  s.samples_withheld(c.withheld);
  s.sensor_rejections(c.sensor_rejections);
  s.filter_restarts(c.restarts);
  s.events_raised(slot.cycle.events().raised_total());
  s.deadline_misses(slot.deadline_misses);
  s.age_s(1e-9 * static_cast<double>(now_ns - (slot.received_ns != 0 ? slot.received_ns : start_ns)));
  s.rate_hz(slot.rate_ns == 0 ? 0.0 : static_cast<double>(c.received - slot.rate_received) / since_s);
  s.latency_p50_us(slot.latency.percentile_us(0.50));
  s.latency_p99_us(slot.latency.percentile_us(0.99));
  s.latency_p999_us(slot.latency.percentile_us(0.999));
  s.latency_max_us(slot.latency.max_us());
  s.writes_refused(slot.writes_refused);
  s.sensors_used(static_cast<std::uint32_t>(slot.cycle.result().estimate.sensors.to_ulong()));
  s.flags(slot.cycle.result().flags);
  s.flight_phase(static_cast<std::uint32_t>(slot.flights.path().phase()));
  s.flight(slot.flights.flight());
  s.n1_corrected_rpm(slot.flights.path().n1_corrected_rpm());
  s.eta(slot.flights.path().eta());
  s.validity_distance(slot.cycle.distance());
  return s;
}

}  // namespace ehm::monitor
