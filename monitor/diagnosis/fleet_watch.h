// SPDX-License-Identifier: Apache-2.0
#pragma once
// Does the estimated engine belong to the fleet that the design is made for? Estimates are judged as inputs are: a slow
// drift of sensors, or wear beyond what the linear model was verified with, passes every check of a single sample.
//
//   Cq  = (M M^T + S), the rows of q       covariance of the tuner estimate over the fleet: its health, its
//                                          nonlinearity and the noise; M and S are the limits of error_propagation.h
//   d^2 = q^T Cq^-1 q                      chi-square with t degrees of freedom for an engine of the fleet
//   e   = d^2 / t                          excess: the most likely square of how much wider than the fleet a population
//                                          is that has such an engine; 1 up to c997, the distance^2 beyond which three
//                                          engines in a thousand lie, linear from there to c999
//   z_i = |h_i - trim_i| / sigma_i         estimate of health parameter i in sigmas of the prior
//   Cy  = H W Cq W^T H^T + R / samples     of the steady sensors that the filter believes in, its noise so that it is
//                                          definite; samples: of the slowest time constant
//   y_i = |Cy^-1 H W q|_i / root of (Cy^-1)_ii                       how far sensor i stands beside the others
//
// The errors of prior and nonlinearity were measured over the fleet; beyond it the first grows as d, the second as d^2,
// and e tells by how much (ErrorPropagation::widen; tuner_design evaluate --wear measures it). Raised after
// persistence_s in a row, ended below 0.8 of the limit:
//   implausible      z_i above warn_sigma
//   unlikely_engine  d above the chi-square's root with the tail of warn_sigma; it names the sensors with y_i above 4
//   withheld         either farther out by withhold_sigma / warn_sigma: no estimate is published
// A bias of one sensor stands out so, too, from the first sample on; slow_bias.h tells which one it is. Scaled units
// but for health. Real-time safe: yes, after construction.
//
// @throws std::runtime_error at construction of the tables if a closed loop is not stable.

#include <memory>
#include <optional>
#include <vector>

#include "monitor/data/events.h"
#include "monitor/data/options.h"
#include "monitor/design/design.h"
#include "monitor/estimation/capacity.h"
#include "monitor/estimation/error_propagation.h"

namespace ehm::monitor {

/// Constants of one sensor set.
struct FleetTable {
  estimation::BoundedMatrix<estimation::max_tuners, estimation::max_tuners> information;  ///< Cq^-1
  estimation::BoundedMatrix<estimation::max_sensors, estimation::max_tuners> stance;      ///< y = |stance q|
  double tuners = 0.0, common = 0.0, ordinary = 0.0;                                      ///< t, c997, c999

  /// d^2. Real-time safe: yes, both.
  double distance2(const estimation::TunerVector& q) const noexcept { return q.dot(information.lazyProduct(q)); }
  double excess(double distance2) const noexcept {
    if (distance2 <= common) return 1.0;
    if (distance2 >= ordinary) return distance2 / tuners;
    return 1.0 + (distance2 - common) / (ordinary - common) * (ordinary / tuners - 1.0);
  }
};

/// [0] full set, [1 + i] without sensor i, empty where no design flies so.
using FleetTables = std::vector<std::optional<FleetTable>>;

/// `error` as make_error_model makes it of the same subset.
FleetTable fleet_table(const design::Design& design, const design::SubsetDesign& subset,
                       const estimation::ErrorModel& error);
/// What the watches of all engines of one design share. `error_models` as FleetTables.
std::shared_ptr<const FleetTables> fleet_tables(const design::Design& design,
                                                const std::vector<estimation::ErrorModel>& error_models);

class FleetWatch {
 public:
  FleetWatch(const FleetOptions& options, const linear_model::LinearModel& model,
             std::shared_ptr<const FleetTables> tables);

  /// Takes the estimate of one sample; `missing` is the sensor that the present design lacks, -1 for none.
  void check(const estimation::TunerVector& tuners, const estimation::HealthVector& health, int missing,
             EventList& events) noexcept;
  /// The filter starts anew.
  void reset(EventList& events) noexcept;

  /// e of the latest sample.
  double excess() const noexcept { return excess_; }
  /// Farther out than the fleet's engines, by any of the events.
  bool implausible() const noexcept { return implausible_; }
  /// Too far out for any estimate.
  bool withheld() const noexcept { return overflown_ || withheld_.raised; }

 private:
  /// A limit that must be exceeded for a while, and is left again at once.
  struct Persistent {
    std::int64_t above = 0;
    bool raised = false;
    bool check(double value, double limit, std::int64_t persistence) noexcept;
  };
  std::uint32_t apart(const estimation::TunerVector& tuners, const FleetTable& table) const noexcept;

  std::shared_ptr<const FleetTables> tables_;
  std::vector<double> distance_limits_;  ///< as tables_
  double warn_sigma_, farther_;          ///< withhold_sigma over it
  std::int64_t persistence_samples_;
  estimation::HealthVector trim_, sigma_;
  std::vector<Persistent> far_;
  Persistent far_together_, withheld_;
  std::vector<Condition> implausible_health_;
  Condition unlikely_;
  double excess_ = 1.0;
  bool implausible_ = false, overflown_ = false;  ///< a distance that is no number: no estimate is one either
};

}  // namespace ehm::monitor
