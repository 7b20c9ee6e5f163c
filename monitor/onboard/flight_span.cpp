// SPDX-License-Identifier: Apache-2.0
#include "monitor/onboard/flight_span.h"

#include <limits>

#include "engine_sim/model/parts/root_theta.h"
#include "engine_sim/model/solve/newton.h"
#include "engine_sim/model/solve/steady.h"

namespace ehm::onboard {
namespace {

namespace sim = engine_sim;

struct FlightCorner {
  sim::FlightCondition flight;
  double n1_share;  ///< of the corrected fan speed at the design point
};
constexpr FlightCorner corners[] = {{{0.0, 0.0, -30.0}, 0.43},    {{0.0, 0.0, 30.0}, 0.43},
                                    {{-300.0, 0.3, -30.0}, 1.04}, {{0.0, 0.3, 30.0}, 1.04},
                                    {{11000.0, 0.8, 15.0}, 1.04}, {{11000.0, 0.8, -15.0}, 0.6}};

}  // namespace

estimation::SensorSpan flight_span(const sim::Turbofan& engine, const sim::NamedChannels& channels) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto count = as_index(channels.sensors.size());
  estimation::SensorSpan span{estimation::SensorVector::Constant(count, infinity),
                              estimation::SensorVector::Constant(count, -infinity)};
  const sim::DesignPoint& design = engine.data().design;
  const double design_n1_corrected_rpm = design.speeds.n1_rpm / sim::root_theta(engine.data().inlet, design.flight);
  for (const FlightCorner& corner : corners) {
    const double n1_rpm =
        corner.n1_share * design_n1_corrected_rpm * sim::root_theta(engine.data().inlet, corner.flight);
    try {
      const sim::SteadyPoint point = sim::solve_steady(engine, corner.flight, {}, {sim::DemandKind::n1_rpm, n1_rpm});
      for (Eigen::Index i = 0; i < count; ++i) {
        const double reading = channels.sensors[as_size(i)].quantity->read(point.gas, engine.data().ratings);
        span.least(i) = std::min(span.least(i), reading);
        span.greatest(i) = std::max(span.greatest(i), reading);
      }
    } catch (const sim::SolveError&) {
      continue;  // an engine that does not run there
    }
  }
  return span;
}

}  // namespace ehm::onboard
