// SPDX-License-Identifier: Apache-2.0
#pragma once
// What the on-board estimators of all engines of one type share: the engine of its file, the same engine with each
// cause of mismatch at one standard deviation, where its channels stand among the gas path's quantities, and the
// settings of the filter.
// Units: those of the channels; settings in the units of their names, percent of the reading where they say percent.
// Errors: @throws std::invalid_argument for a channel that has no place among the gas path's quantities (names it).

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "engine_sim/engines/engine_definition.h"
#include "engine_sim/mismatch/mismatch.h"
#include "engine_sim/model/turbofan.h"
#include "monitor/estimation/estimator.h"

namespace ehm::onboard {

/// Settings of on_board_estimator.h, with its letters.
struct OnBoardOptions {
  double sample_time_s = 0.015;
  bool build = true, soak = true, inputs = true;  ///< whether these causes of mismatch are among the unknowns
  /// A gain that the tangent at the start gives is not to be trusted: R += (this tr Ph/tr Ph(fleet))^2, at 15 ms.
  double early_gain_percent = 6.0;
  double speed_walk_percent = 5e-4;   ///< what the model leaves out of the spools, standard deviation a 15 ms step
  double health_walk_percent = 1e-4;  ///< the same of health
  /// The path-driven bias of a sensor: this share of what the causes do to it is not where the model puts it, and the
  /// slopes by health are wrong by so much, as the engine moves by these lengths.
  double path_share = 0.2, path_slope_error = 0.005;
  double output_share = 0.4;      ///< the same share of an auxiliary output, which nothing measures
  double path_length_n1 = 0.107;  ///< of the corrected fan speed at the design point
  double path_length_mach = 0.2;
  double soak_error = 0.1;  ///< of what the metal's heat does to a reading
  double least_n1 = 0.43;   ///< of the corrected fan speed at the design point: below, only the speeds are followed
  /// When the mean innovation says that a health parameter has stepped (step_watch.h).
  double step_mean_s = 2.0, step_confirm_s = 0.5, step_threshold = 50.0, step_explains = 0.7;
  double step_floor_percent = 0.05;  ///< of a reading's mean innovation, what nothing else explains
  double step_bias_percent = 1.0;    ///< of a sensor, where it may have been that
  double refresh_speed = 0.002;      ///< relative change of a speed after which the tangent is renewed
  double refresh_time_s = 1.0;       ///< longest age of a tangent: health and flight move it too
};

/// The place of a channel among gas_path_quantity, and the sign with which it counts.
struct QuantityPlace {
  std::size_t place;
  double sign = 1.0;
};

/// How a cause acts on the model: through the engine's data, through what is reported, or through the metal.
enum class CauseKind { engine, input, conductance, capacity };

/// In the model itself, where its value is the estimate; the others are taken to be linear around none.
constexpr bool of_metal(CauseKind kind) {
  return kind == CauseKind::conductance || kind == CauseKind::capacity;
}

/// A cause that is estimated: of the fleet's engines one standard deviation is `sigma`.
struct OnBoardCause {
  CauseKind kind;
  std::size_t index;  ///< among mismatch_causes()
  double sigma;
  std::shared_ptr<const engine_sim::Turbofan> altered;  ///< of kind engine: with this cause at sigma
};

class OnBoardModel {
 public:
  /// `noise_sigma`: of each sensor in its unit; none: the percent of the engine file, of the present reading.
  OnBoardModel(std::shared_ptr<const engine_sim::EngineDefinition> engine, const OnBoardOptions& options,
               std::vector<double> noise_sigma = {});

  const engine_sim::EngineDefinition& definition() const { return *definition_; }
  const engine_sim::Turbofan& engine() const { return engine_; }
  const OnBoardOptions& options() const { return options_; }
  const std::vector<QuantityPlace>& sensors() const { return sensors_; }
  const std::vector<QuantityPlace>& auxiliary() const { return auxiliary_; }
  const std::vector<OnBoardCause>& causes() const { return causes_; }
  /// Standard deviation of a sensor's noise where it reads so much, with what its resolution adds.
  double noise_sigma(std::size_t sensor, double reading) const;
  /// Which sensor measures this spool, 0: N1, 1: N2; -1: none does.
  int speed_sensor(int spool) const { return speed_sensors_[static_cast<std::size_t>(spool)]; }
  /// N1/sqrt(theta2) of the design point.
  double design_n1_corrected_rpm() const { return design_n1_corrected_rpm_; }
  /// What its sensors read over all flights.
  const estimation::SensorSpan& span() const { return span_; }
  /// Time constant of the slowest metal, C/k; 1 s at least.
  double soak_time_s() const { return soak_time_s_; }

 private:
  std::shared_ptr<const engine_sim::EngineDefinition> definition_;
  OnBoardOptions options_;
  engine_sim::Turbofan engine_;
  std::vector<double> noise_sigma_;
  std::vector<QuantityPlace> sensors_, auxiliary_;
  std::array<int, 2> speed_sensors_{-1, -1};
  std::vector<OnBoardCause> causes_;
  double design_n1_corrected_rpm_, soak_time_s_;
  estimation::SensorSpan span_;
};

}  // namespace ehm::onboard
