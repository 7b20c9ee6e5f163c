// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/import/assemble_noise.h"

#include <cmath>
#include <stdexcept>

#include "deploy/runtime/files/csv_table.h"
#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"
#include "engine_sim/linear_model/sensor_noise.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/import/assemble_channels.h"

namespace ehm::tuner_design {
namespace {

using files::shown;
using files::throw_defect;
using linear_model::LinearModel;

std::string place(const std::string& name, Eigen::Index row, Eigen::Index col) {
  return name + "(" + std::to_string(row + 1) + "," + std::to_string(col + 1) + ")";
}

/// Standard deviations and the like, each above zero; NaN where nothing is stated.
Eigen::VectorXd sigmas(const Variables& given, const std::string& name, Eigen::Index size, const std::string& each) {
  Eigen::VectorXd sigma = vector_of(given, name, size, each, true);
  for (Eigen::Index i = 0; i < size; ++i) {
    if (std::isnan(sigma(i)) || sigma(i) > 0.0) continue;
    throw_defect(given.source, name + "(" + std::to_string(i + 1) + ")", shown(sigma(i)), "above 0",
                 "Give a standard deviation in the channel's unit");
  }
  return sigma;
}

/// Square roots of the diagonal of R, which is m x m, a vector of variances, or one variance for all sensors.
Eigen::VectorXd sigmas_of_covariance(const Variables& given, Eigen::Index m) {
  const Eigen::MatrixXd& R = *given.find("R");
  const bool full = R.rows() == m && R.cols() == m;
  const Eigen::VectorXd variance = full ? Eigen::VectorXd(R.diagonal()) : vector_of(given, "R", m, "row of C", true);
  for (Eigen::Index i = 0; i < m; ++i) {
    if (variance(i) > 0.0) continue;
    throw_defect(given.source, place("R", i, i), shown(variance(i)), "above 0",
                 "R is singular; give the variance of one sample's noise, or leave the sensor out");
  }
  for (Eigen::Index i = 0; full && i < m; ++i) {
    for (Eigen::Index j = 0; j < m; ++j) {
      if (i == j || std::abs(R(i, j)) <= 1e-9 * std::sqrt(variance(i) * variance(j))) continue;
      throw_defect(given.source, place("R", i, j), shown(R(i, j)), "0 off the diagonal",
                   "The filter takes the sensors' noise as independent; give sensor_noise_sigma");
    }
  }
  return variance.cwiseSqrt();
}

void assemble_health_sigma(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  LinearModel& model = result.model;
  model.health_sigma = sigmas(given, "health_sigma", as_index(model.health.size()), "column of L");
  const double percent = options.health_sigma_percent.value_or(ImportOptions::default_health_sigma_percent);
  std::vector<bool> missing(model.health.size());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    double& sigma = model.health_sigma(as_index(i));
    missing[i] = std::isnan(sigma);
    const bool in_percent = model.health[i].unit == "percent" || model.health[i].unit == "%";
    if (missing[i]) sigma = in_percent ? percent : percent / 100.0;
  }
  const std::string who = listed(model.health, missing);
  if (who.empty() && options.health_sigma_percent) refuse_option(given, "health_sigma", "--health-sigma");
  if (!who.empty() && !options.health_sigma_percent) {
    result.assumed.push_back(who + ": fleet's sigma " + files::shortest(percent) +
                             " %, since health_sigma is not stated (--health-sigma)");
  }
}

/// A trim near zero, as that of a pressure difference, says nothing of the noise: half a percent of it may be a
/// millionth of what the fleet's health moves the sensor by.
void require_plausible_noise(const Variables& given, const LinearModel& model, const std::vector<bool>& assumed) {
  constexpr double least = 1e-4;  // of the fleet's spread; instruments reach 1e-3
  Eigen::MatrixXd H;
  try {
    H = estimation::steady_gain(model).H;
  } catch (const std::runtime_error&) {
    return;  // check_model says why there is no steady state
  }
  for (std::size_t i = 0; i < assumed.size(); ++i) {
    const auto at = as_index(i);
    const double spread = (H.row(at) * model.health_sigma.asDiagonal()).norm();
    if (!assumed[i] || model.sensor_noise_sigma(at) >= least * spread) continue;
    throw files::FileError(given.source + ": the noise of sensor " + model.sensors[i].name + " (" +
                           model.sensors[i].unit + ") is not stated, and cannot be assumed in percent of trim, since " +
                           files::shortest(model.sensors[i].trim) + " is near zero: the fleet's health moves it by " +
                           files::shortest(spread) + ". Give sensor_noise_sigma or R.");
  }
}

void assemble_sensor_noise(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  LinearModel& model = result.model;
  const auto m = as_index(model.sensors.size());
  const bool covariance = given.find("R") != nullptr && given.find("R")->size() > 0;
  Eigen::VectorXd& sigma = model.sensor_noise_sigma;
  sigma = sigmas(given, "sensor_noise_sigma", m, "row of C");
  if (covariance && !sigma.array().isNaN().all())
    throw files::FileError(given.source + ": R and sensor_noise_sigma are both there. Remove one of them.");
  if (covariance) sigma = sigmas_of_covariance(given, m);
  const double percent = options.sensor_noise_percent.value_or(ImportOptions::default_sensor_noise_percent);
  std::vector<bool> missing(model.sensors.size());
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const auto at = as_index(i);
    missing[i] = std::isnan(sigma(at));
    if (!missing[i]) continue;
    const double one_percent = linear_model::percent_of_trim(model.sensors[i], 0.0);
    if (one_percent == 0.0) {
      throw files::FileError(given.source + ": the noise of sensor " + model.sensors[i].name + " (" +
                             model.sensors[i].unit +
                             ") is not stated, and cannot be assumed in percent of trim, since "
                             "its trim is not stated, 0, or a gauge pressure. Give sensor_noise_sigma or R.");
    }
    sigma(at) = one_percent * percent;
  }
  require_plausible_noise(given, model, missing);
  const std::string who = listed(model.sensors, missing);
  if (who.empty() && options.sensor_noise_percent) refuse_option(given, "the sensors' noise", "--sensor-noise");
  if (!who.empty() && !options.sensor_noise_percent) {
    result.assumed.push_back(who + ": noise sigma " + files::shortest(percent) +
                             " % of trim, since sensor_noise_sigma is not stated (--sensor-noise)");
  }
}

/// What sensors state of their resolution or update period, 0 where one does not; empty where none does.
Eigen::VectorXd fineness(const Variables& given, const std::string& name, Eigen::Index m) {
  const Eigen::VectorXd values =
      vector_of(given, name, m, "row of C", true).unaryExpr([](double v) { return std::isnan(v) ? 0.0 : v; });
  for (Eigen::Index i = 0; i < m; ++i) {
    if (values(i) >= 0.0) continue;
    throw_defect(given.source, name + "(" + std::to_string(i + 1) + ")", shown(values(i)), "0 (not known) or above",
                 name == "sensor_update_period_s" ? "Give the time between two values in seconds"
                                                  : "Give the step of its values in the channel's unit");
  }
  return values.isZero(0.0) ? Eigen::VectorXd() : values;
}

/// Rounding and holding count in the noise (sensor_noise.h).
void assemble_fineness(const Variables& given, LinearModel& model) {
  const Eigen::Index m = model.sensor_noise_sigma.size();
  model.sensor_resolution = fineness(given, "sensor_resolution", m);
  model.sensor_update_period_s = fineness(given, "sensor_update_period_s", m);
  for (Eigen::Index i = 0; i < m; ++i)
    model.sensor_noise_sigma(i) = linear_model::counted_sigma(model, i, model.sensor_noise_sigma(i));
}

void assume_process_noise(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  LinearModel& model = result.model;
  const double percent = options.process_noise_percent.value_or(ImportOptions::default_process_noise_percent);
  Eigen::VectorXd sigma(model.A.rows());
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    const linear_model::Channel& state = model.states[as_size(i)];
    sigma(i) = percent * linear_model::percent_of_trim(state, 0.0);
    if (sigma(i) > 0.0) continue;
    throw files::FileError(given.source +
                           ": Q is not stated, and cannot be assumed in percent of trim, since the trim "
                           "of state " +
                           state.name + " (" + state.unit +
                           ") is not stated, 0, or a gauge pressure. Give Q per sample.");
  }
  model.process_noise = sigma.cwiseAbs2().asDiagonal();
  if (options.process_noise_percent) return;
  result.assumed.push_back("process noise of the states: sigma " + files::shortest(percent) +
                           " % of trim per sample, since Q is not stated (--process-noise)");
}

void assemble_process_noise(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  LinearModel& model = result.model;
  const Eigen::Index n = model.A.rows();
  const Eigen::MatrixXd* Q = given.find("Q");
  if (Q == nullptr || Q->size() == 0) return assume_process_noise(given, options, result);
  if (options.process_noise_percent) refuse_option(given, "Q", "--process-noise");
  const bool full = Q->rows() == n && Q->cols() == n;
  model.process_noise = full ? *Q : Eigen::MatrixXd(vector_of(given, "Q", n, "row of A", true).asDiagonal());
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double lower = model.process_noise(i, j), upper = model.process_noise(j, i);
      if (std::abs(lower - upper) <= 1e-9 * model.process_noise.norm()) continue;
      throw_defect(given.source, place("Q", i, j), shown(lower), shown(upper) + " as " + place("Q", j, i),
                   "A covariance is symmetric; (Q + Q')/2 is, if this is round-off");
    }
  }
}

}  // namespace

void refuse_option(const Variables& given, const std::string& stated, const std::string& option) {
  throw files::FileError(given.source + ": states " + stated + ", so that " + option +
                         " would do nothing; allowed: one of the two. Remove one.");
}

void assemble_noise(const Variables& given, const ImportOptions& options, ImportedModel& result) {
  assemble_health_sigma(given, options, result);
  assemble_sensor_noise(given, options, result);
  assemble_fineness(given, result.model);
  assemble_process_noise(given, options, result);
}

}  // namespace ehm::tuner_design
