// SPDX-License-Identifier: Apache-2.0
#pragma once
// Tables IV and V and figures 5.3 to 5.5 of Endurthi's thesis on our engine: health estimated by the filters of
// health_filter.h, on each of the 27 linear models and on the tangent, of a nonlinear engine that wears.
//   flight   3 s at 10 Hz of the settled engine, held by its own control: 30 samples with noise; estimate and covariance
//            are carried to the next one. A flight stands for 12 cycles of wear (wear/wear_law.h), so that 500 of them, the
//            thesis' long figure, are the 6000 cycles of the table
//   error    RMS over 20 runs and 50 flights of the estimate at each flight's end, absolute and in percent of the true
//            change after the last one (a reading: the thesis says percent only)
// and one run of 500 flights whose model is made anew at the estimate every 100, on LIN120, the thesis' best.
// All models and filters see the same noise: run i draws from the stream (seed, i). The same bytes on any number of
// threads. Errors: those of the engine and of block_columns.h.

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tuner_design/endurthi/health_filter.h"

namespace ehm::tuner_design::endurthi {

struct HealthStudyOptions {
  std::shared_ptr<const engine_sim::EngineDefinition> engine;
  std::size_t runs = 20, flights = 50, life_flights = 500, relinearised_each = 100;
  double cycles_per_flight = 12.0;
  double linearised_with_percent = 0.1;  ///< step of the linear models (the thesis does not say for these tables)
  FilterSettings filter;
  std::uint64_t seed = 1;
  unsigned threads = 1;
};

/// By health parameter; the last number of each is the mean.
struct HealthErrors {
  std::vector<double> percent, of_change;
};

struct ModelHealth {
  std::string model;                                           ///< "000" to "222", or "tangent"
  std::array<HealthErrors, filter_kind_names.size()> by_kind;  ///< in the order of FilterKind
};

/// Of one run over a life, by health parameter, percent.
struct LifeFlight {
  std::vector<double> truth;
  std::array<std::vector<double>, filter_kind_names.size()> estimates;
};

struct HealthPoint {
  std::string name;
  double n1_rpm = 0.0;
  std::vector<std::string> health;
  Eigen::VectorXd change;  ///< true, percent, after the last flight of the tables
  std::vector<ModelHealth> models;
  std::vector<LifeFlight> life;
};

struct HealthStudy {
  HealthStudyOptions options;
  std::vector<HealthPoint> points;
};

inline constexpr int samples_a_flight = 30;

/// The settled engine of one flight, absolute, without noise.
struct FlightTruth {
  Eigen::VectorXd health_percent, y, u;
};
FlightTruth truth_of(const StudyPoint& point, double cycles);
/// Root mean squares, percent and percent of the change, with their means at the end.
HealthErrors errors_of(const Eigen::VectorXd& mean_squares, const Eigen::VectorXd& change);

inline constexpr std::size_t life_model = 15;  ///< LIN120

/// `progress`: share of the work.
HealthStudy run_health_study(
    const HealthStudyOptions& options, const std::function<void(double)>& progress = [](double) {});

}  // namespace ehm::tuner_design::endurthi
