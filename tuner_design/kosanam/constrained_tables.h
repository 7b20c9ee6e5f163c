// SPDX-License-Identifier: Apache-2.0
#pragma once
// Kosanam's table 5.1 and figures 5.1 to 5.3: what a Kalman filter gains when it knows that health does not improve,
// and what the constraint does to it beside: the ratchet (theory.md, "Constrained filters"). The same filters besides
// over a sweep of the random walk's variance qh; the table is that of the qh at which the plain filter errs least.
//
// *Readings*: the thesis constrains each time step against its last constrained estimate, and does not say by which
// weight, nor whether it feeds back: all are flown. qh of the engine's file; its "1e-2" has no unit. Health wears to
// the end of the wear table (wear_law.h), whatever the number of flights. Errors: @throws what batch_problem and
// steady_filter throw.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "tuner_design/kosanam/flight_batches.h"

namespace ehm::tuner_design {

inline constexpr double whole_life_cycles = 6000.0;  ///< that the flights of a study stand for

struct ConstrainedTablesOptions {
  BatchOptions batch;
  double health_variance = 25e-6;                             ///< percent squared a sample: of the MAPSS file
  std::vector<double> sweep{0.1, 0.3, 1.0, 3.0, 10.0, 30.0};  ///< of it
};

/// In this order in every result.
namespace constrained_case {
enum Case : std::size_t {
  kalman,
  time_varying,
  identity,
  projection,
  identity_fed_back,
  projection_fed_back,
  projection_behind,
  projection_behind_fed_back,
  truncation,
  truncation_fed_back,
  truncation_2_behind,
  truncation_3_behind
};
}  // namespace constrained_case

struct SweepPoint {
  double factor = 1.0;
  BatchResult result;
};

struct ConstrainedTables {
  ConstrainedTablesOptions options;
  std::string model;
  std::vector<std::string> health, not_known;  ///< not_known: wear as fan_efficiency
  double sample_time_s = 0.0;
  std::vector<SweepPoint> sweep;
  std::size_t best = 0;  ///< of sweep, where the plain filter errs least

  const BatchResult& table() const { return sweep[best].result; }
  /// Of mean errors, percent of nominal.
  double ratio(constrained_case::Case constrained) const {
    return table().mean_rms(constrained) / table().mean_rms(constrained_case::kalman);
  }
};

/// As published, percent: unconstrained, constrained.
inline constexpr std::array<std::array<double, 2>, 8> published_5_1{
    {{4.8, 4.4}, {5.8, 4.6}, {3.4, 2.7}, {4.8, 3.8}, {3.0, 2.4}, {4.5, 3.8}, {4.5, 4.2}, {6.3, 4.3}}};
inline constexpr std::array<double, 2> published_5_1_average{4.6, 3.7};

ConstrainedTables constrained_tables(
    const linear_model::LinearModel& model, const ConstrainedTablesOptions& options,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design
