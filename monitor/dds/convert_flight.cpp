// SPDX-License-Identifier: Apache-2.0
#include "monitor/dds/convert_flight.h"

#include <algorithm>
#include <cmath>

#include "idl/wire_values.h"

namespace ehm::monitor {

void convert(const Flight& f, FlightSummary& s) {
  const auto seen = [](double value) { return std::isfinite(value) ? value : 0.0; };
  s = {};
  s.schema(idl::schema_version);
  s.flight(f.number);
  s.start_time_ns(f.start_ns);
  s.landing_time_ns(f.landing_ns);
  s.samples_accepted(f.samples);
  s.samples_estimated(f.estimated);
  s.flags(f.flags);
  s.events_raised(f.events);
  s.exceedances(f.exceedances);
  s.sensor_count(static_cast<std::uint32_t>(f.sensors.size()));
  s.health_count(static_cast<std::uint32_t>(f.health.size()));
  s.auxiliary_count(static_cast<std::uint32_t>(f.auxiliary.size()));
  s.flights_learned(f.flights_learned);
  std::copy(f.phase_s.begin(), f.phase_s.end(), s.phase_s().begin());
  for (std::size_t i = 0; i < f.health.size(); ++i) {
    s.health()[i] = f.health[i].value;
    s.sigma_total()[i] = f.health[i].sigma;
    s.wear()[i] = f.health[i].wear;
  }
  for (std::size_t i = 0; i < f.sensors.size(); ++i) s.sensor_greatest()[i] = seen(f.sensors[i].greatest);
  for (std::size_t i = 0; i < f.auxiliary.size(); ++i) {
    s.auxiliary_least()[i] = seen(f.auxiliary[i].least);
    s.auxiliary_greatest()[i] = seen(f.auxiliary[i].greatest);
  }
  s.margins_known(f.margins ? 1 : 0);
  if (f.margins) {
    s.egt_margin_k(f.margins->egt_k);
    s.egt_margin_sigma_k(f.margins->egt_sigma_k);
    s.thrust_margin(f.margins->thrust);
    s.thrust_margin_sigma(f.margins->thrust_sigma);
  }
  s.design_hash() = f.design_hash.c_str();
}

}  // namespace ehm::monitor
