// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/scaling.h"

#include <cmath>
#include <optional>
#include <stdexcept>

#include "deploy/runtime/numbers/index.h"
#include "deploy/runtime/units/units.h"

namespace ehm::linear_model {
namespace {

bool in_percent(const Channel& channel) {
  return channel.unit == "percent" || channel.unit == "%";
}

double health_scale(const Channel& channel) {
  if (channel.unit == "fraction" || channel.unit == "-") return 0.01;
  if (in_percent(channel)) return 1.0;
  throw std::invalid_argument("health parameter " + channel.name + " has unit '" + channel.unit +
                              "'; allowed: fraction, -, percent, %");
}

struct ReportingUnit {
  double scale;
  std::string name;
};

/// To kelvin; nothing where the channel is no temperature.
std::optional<units::Conversion> to_kelvin(const Channel& channel) noexcept {
  if (channel.unit.empty()) return std::nullopt;
  return units::conversion(channel.unit, "K");
}

ReportingUnit auxiliary_scale(const Channel& channel) {
  const std::string& unit = channel.unit;
  if (const auto kelvin = to_kelvin(channel)) return {1.0 / kelvin->factor, "K"};
  if (in_percent(channel) || unit == "point" || unit == "points") return {1.0, "points"};
  if (unit == "fraction" || unit == "-") return {0.01, "points"};
  if (units::is_gauge_pressure(unit)) return {1.0, unit};
  if (channel.trim == 0.0) {
    throw std::invalid_argument("auxiliary output " + channel.name + " in " + unit +
                                " has trim 0; allowed: non-zero, since its error is reported in percent of trim");
  }
  return {std::abs(channel.trim) / 100.0, "percent"};
}

Eigen::MatrixXd rescaled(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& rows, const Eigen::VectorXd& cols) {
  return rows.cwiseInverse().asDiagonal() * matrix * cols.asDiagonal();
}

}  // namespace

double unit_of_health(const Channel& parameter) {
  return 100.0 * health_scale(parameter);
}

double size_of_trim(const Channel& channel) noexcept {
  if (units::is_gauge_pressure(channel.unit)) return 0.0;
  const auto kelvin = to_kelvin(channel);
  const bool from_absolute_zero = !kelvin || kelvin->offset == 0.0;
  return std::abs(from_absolute_zero ? channel.trim : channel.trim + kelvin->offset / kelvin->factor);
}

double percent_of_trim(const Channel& channel, double without_trim) {
  if (const double size = size_of_trim(channel); size > 0.0) return size / 100.0;
  return in_percent(channel) ? 1.0 : without_trim;
}

Scaling scaling_of(const LinearModel& model) {
  const auto n = as_index(model.states.size());
  const auto m = as_index(model.sensors.size());
  const auto p = as_index(model.health.size());
  const auto r = as_index(model.auxiliary.size());
  Scaling scaling{Eigen::VectorXd(n), Eigen::VectorXd(m), Eigen::VectorXd(p), Eigen::VectorXd(r), {}};
  for (Eigen::Index i = 0; i < n; ++i) scaling.state(i) = percent_of_trim(model.states[as_size(i)], 1.0);
  for (Eigen::Index i = 0; i < m; ++i) {
    scaling.sensor(i) = percent_of_trim(model.sensors[as_size(i)], model.sensor_noise_sigma(i));
  }
  for (Eigen::Index i = 0; i < p; ++i) scaling.health(i) = health_scale(model.health[as_size(i)]);
  for (Eigen::Index i = 0; i < r; ++i) {
    const ReportingUnit unit = auxiliary_scale(model.auxiliary[as_size(i)]);
    scaling.auxiliary(i) = unit.scale;
    scaling.auxiliary_unit.push_back(unit.name);
  }
  return scaling;
}

LinearModel scaled(const LinearModel& model, const Scaling& scaling) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(as_index(model.controls.size()));
  LinearModel result = model;
  result.A = rescaled(model.A, scaling.state, scaling.state);
  result.B = rescaled(model.B, scaling.state, one);
  result.L = rescaled(model.L, scaling.state, scaling.health);
  result.C = rescaled(model.C, scaling.sensor, scaling.state);
  result.D = rescaled(model.D, scaling.sensor, one);
  result.M = rescaled(model.M, scaling.sensor, scaling.health);
  result.F = rescaled(model.F, scaling.auxiliary, scaling.state);
  result.G = rescaled(model.G, scaling.auxiliary, one);
  result.N = rescaled(model.N, scaling.auxiliary, scaling.health);
  result.process_noise = rescaled(model.process_noise, scaling.state, scaling.state.cwiseInverse());
  if (model.linearisation_error.size() > 0) {
    Eigen::VectorXd output(scaling.sensor.size() + scaling.auxiliary.size());
    output << scaling.sensor, scaling.auxiliary;
    result.linearisation_error = rescaled(model.linearisation_error, output, output.cwiseInverse());
  }
  result.health_sigma = model.health_sigma.cwiseQuotient(scaling.health);
  result.sensor_noise_sigma = model.sensor_noise_sigma.cwiseQuotient(scaling.sensor);
  if (model.sensor_resolution.size() > 0)
    result.sensor_resolution = model.sensor_resolution.cwiseQuotient(scaling.sensor);
  for (std::size_t i = 0; i < result.states.size(); ++i) {
    result.states[i].trim /= scaling.state(as_index(i));
    result.states[i].unit = size_of_trim(model.states[i]) > 0.0 ? "percent" : model.states[i].unit;
  }
  for (std::size_t i = 0; i < result.sensors.size(); ++i) {
    result.sensors[i].trim /= scaling.sensor(as_index(i));
    const bool percent = size_of_trim(model.sensors[i]) > 0.0 || in_percent(model.sensors[i]);
    result.sensors[i].unit = percent ? "percent" : "noise sigma";
  }
  for (std::size_t i = 0; i < result.health.size(); ++i) {
    result.health[i].trim /= scaling.health(as_index(i));
    result.health[i].unit = "percent";
  }
  for (std::size_t i = 0; i < result.auxiliary.size(); ++i) {
    result.auxiliary[i].trim /= scaling.auxiliary(as_index(i));
    result.auxiliary[i].unit = scaling.auxiliary_unit[i];
  }
  return result;
}

}  // namespace ehm::linear_model
