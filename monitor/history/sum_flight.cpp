// SPDX-License-Identifier: Apache-2.0
#include "monitor/history/sum_flight.h"

#include "engine_sim/model/solve/newton.h"
#include "monitor/onboard/take_off_margin.h"

namespace ehm::monitor {

namespace {

std::optional<FlightMargins> margins_of(const estimation::Learned& learned, const onboard::OnBoardModel* model) {
  if (model == nullptr || learned.empty()) return std::nullopt;
  try {
    const onboard::TakeOffMargin margin = onboard::take_off_margin(*model, learned);
    return FlightMargins{margin.margin_k, margin.sigma_k, margin.thrust, margin.thrust_sigma};
  } catch (const engine_sim::SolveError&) {
    return std::nullopt;
  }
}

}  // namespace

Flight sum_flight(const FlightTotals& totals, const estimation::Learned& learned, const design::Design& design,
                  const onboard::OnBoardModel* model) {
  Flight f;
  f.number = totals.flight;
  f.start_ns = totals.start_ns;
  f.landing_ns = totals.landing_ns;
  f.design_hash = design.hash;
  f.samples = totals.samples;
  f.estimated = totals.estimated;
  f.flags = totals.flags;
  f.events = totals.events;
  f.exceedances = totals.exceedances;
  f.phase_s = totals.phase_s;
  for (Eigen::Index i = 0; i < totals.health.size(); ++i) {
    const auto& channel = design.model.health[as_size(i)];
    f.health.push_back({channel.name, channel.unit, totals.health(i), totals.health_sigma(i), 0.0});
  }
  for (Eigen::Index i = 0; i < totals.sensor_greatest.size(); ++i) {
    const auto& channel = design.model.sensors[as_size(i)];
    f.sensors.push_back({channel.name, channel.unit, totals.sensor_greatest(i), totals.sensor_greatest(i)});
  }
  for (Eigen::Index i = 0; i < totals.auxiliary_least.size(); ++i) {
    const auto& channel = design.model.auxiliary[as_size(i)];
    f.auxiliary.push_back({channel.name, channel.unit, totals.auxiliary_least(i), totals.auxiliary_greatest(i)});
  }
  f.margins = margins_of(learned, model);
  return f;
}

}  // namespace ehm::monitor
