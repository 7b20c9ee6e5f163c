// SPDX-License-Identifier: Apache-2.0
#include "engine_sim/linear_model/model_check.h"

#include <complex>
#include <set>

#include "deploy/runtime/files/file_error.h"
#include "deploy/runtime/files/json_object.h"
#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/scaling.h"

namespace ehm::linear_model {
namespace {

/// Names and units travel in bounded strings.
void check_length(const std::string& text, std::size_t most, const std::string& key, const std::string& file) {
  if (text.size() <= most) return;
  files::throw_defect(file, key, std::to_string(text.size()) + " characters long", "at most " + std::to_string(most),
                      "Shorten it");
}

void check_channels(const std::vector<Channel>& channels, const std::string& list, std::size_t least, int capacity,
                    const std::string& file) {
  const auto most = as_size(capacity);
  if (channels.size() < least || channels.size() > most) {
    files::throw_defect(file, list, std::to_string(channels.size()) + " channels long",
                        std::to_string(least) + " to " + std::to_string(most) + " channels",
                        "Choose the channels that matter most");
  }
  std::set<std::string> names;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string at = list + "[" + std::to_string(i) + "]";
    const std::string& name = channels[i].name;
    if (name.empty()) files::throw_defect(file, at + ".name", "empty", "a text that is not empty", "Name the channel");
    check_length(name, max_name_length, at + ".name", file);
    check_length(channels[i].unit, max_unit_length, at + ".unit", file);
    if (!names.insert(name).second) {
      files::throw_defect(file, at + ".name", "\"" + name + "\" again", "each name once in its list",
                          "Rename one of the two");
    }
    if (!std::isfinite(channels[i].trim)) {
      files::throw_defect(file, at + ".trim", files::shown(channels[i].trim), "a finite number",
                          "Give the value at the trim point");
    }
  }
}

void check_matrix(const Eigen::MatrixXd& matrix, const std::string& key, std::size_t rows, std::size_t cols,
                  const std::string& file) {
  if (as_size(matrix.rows()) != rows || as_size(matrix.cols()) != cols) {
    files::throw_defect(file, key, std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()),
                        std::to_string(rows) + " x " + std::to_string(cols),
                        "Check the matrix against the channel lists");
  }
  if (!matrix.allFinite()) {
    files::throw_defect(file, key, "not finite in an entry", "finite numbers", "Derive the matrix again");
  }
}

void check_matrices(const LinearModel& model, const std::string& file) {
  const std::size_t n = model.states.size(), nu = model.controls.size(), p = model.health.size();
  const std::size_t m = model.sensors.size(), r = model.auxiliary.size();
  check_matrix(model.A, "A", n, n, file);
  check_matrix(model.B, "B", n, nu, file);
  check_matrix(model.L, "L", n, p, file);
  check_matrix(model.C, "C", m, n, file);
  check_matrix(model.D, "D", m, nu, file);
  check_matrix(model.M, "M", m, p, file);
  check_matrix(model.F, "F", r, n, file);
  check_matrix(model.G, "G", r, nu, file);
  check_matrix(model.N, "N", r, p, file);
  check_matrix(model.process_noise, "process_noise", n, n, file);
  if (model.linearisation_error.size() > 0) {
    check_matrix(model.linearisation_error, "linearisation_error", m + r, m + r, file);
  }
  check_matrix(model.health_sigma, "sigma of health", p, 1, file);
  check_matrix(model.sensor_noise_sigma, "noise_sigma of sensors", m, 1, file);
}

void check_positive(const Eigen::VectorXd& values, const std::string& list, const std::string& name,
                    const std::string& remedy, const std::string& file) {
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    if (values(i) > 0.0) continue;
    files::throw_defect(file, list + "[" + std::to_string(i) + "]." + name, files::shown(values(i)), "a number above 0",
                        remedy);
  }
}

void check_covariance(const Eigen::MatrixXd& covariance, const char* key, const char* remedy, const std::string& file) {
  if (!covariance.isApprox(covariance.transpose(), 1e-9)) {
    files::throw_defect(file, key, "not symmetric", "a covariance matrix", remedy);
  }
  const double least = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(covariance).eigenvalues().minCoeff();
  if (least < -1e-12 * covariance.norm()) {
    files::throw_defect(file, key, "a matrix with the eigenvalue " + files::shown(least), "no negative eigenvalue",
                        remedy);
  }
}

void check_units(const LinearModel& model, const std::string& file) {
  // One channel at a time, so that the message can name it.
  for (std::size_t i = 0; i < model.health.size(); ++i) {
    const std::string& unit = model.health[i].unit;
    if (unit == "fraction" || unit == "-" || unit == "percent" || unit == "%") continue;
    files::throw_defect(file, "health[" + std::to_string(i) + "].unit", "\"" + unit + "\"", "fraction, -, percent, %",
                        "Express the health parameter relative to nominal");
  }
  for (std::size_t i = 0; i < model.auxiliary.size(); ++i) {
    LinearModel one;
    one.auxiliary = {model.auxiliary[i]};
    try {
      linear_model::scaling_of(one);
    } catch (const std::invalid_argument&) {
      files::throw_defect(
          file, "auxiliary[" + std::to_string(i) + "].trim", files::shown(model.auxiliary[i].trim),
          "a number other than 0, since errors in " + model.auxiliary[i].unit + " are reported in percent of trim",
          "Give the value at the trim point");
    }
  }
}

/// "0.9 +- 0.3 i"
std::string shown_eigenvalue(const std::complex<double>& value) {
  if (value.imag() == 0.0) return files::shown(value.real());
  return files::shown(value.real()) + " +- " + files::shown(std::abs(value.imag())) + " i";
}

void check_stability(const LinearModel& model, const std::string& file) {
  const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<Eigen::MatrixXd>(model.A, false).eigenvalues();
  Eigen::Index at = 0;
  const double worst = model.discrete ? eigenvalues.cwiseAbs().maxCoeff(&at) : eigenvalues.real().maxCoeff(&at);
  if (model.discrete && !(worst < 1.0)) {
    files::throw_defect(
        file, "A",
        "unstable: its eigenvalue " + shown_eigenvalue(eigenvalues(at)) + " has the modulus " + files::shown(worst),
        "below 1 for time \"discrete\"", "Check the sample time, the sign of A, and whether the model is continuous");
  }
  if (!model.discrete && !(worst < 0.0)) {
    files::throw_defect(file, "A", "unstable: its eigenvalue " + shown_eigenvalue(eigenvalues(at)) + " does not decay",
                        "real part below 0 for time \"continuous\"",
                        "Check the sign of A, and whether the model is discrete");
  }
}

/// What sensors may state: empty, or a number for each that is not below zero.
void check_optional(const Eigen::VectorXd& values, const LinearModel& model, const char* key, const std::string& file) {
  if (values.size() == 0) return;
  check_matrix(values, std::string(key) + " of sensors", model.sensors.size(), 1, file);
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (values(i) < 0.0)
      files::throw_defect(file, "sensors[" + std::to_string(i) + "]." + key, files::shown(values(i)), "above 0",
                          "Give it, or leave it out where it is not known");
}

/// More than the whole of nominal is a wrong unit.
void check_health_sigma(const LinearModel& model, const std::string& file) {
  for (std::size_t i = 0; i < model.health.size(); ++i) {
    const bool fraction = model.health[i].unit == "fraction" || model.health[i].unit == "-";
    const double most = fraction ? 1.0 : 100.0, sigma = model.health_sigma(as_index(i));
    if (sigma <= most) continue;
    files::throw_defect(file, "health[" + std::to_string(i) + "].sigma", files::shown(sigma),
                        "at most " + files::shown(most), "Check its unit, " + model.health[i].unit);
  }
}

}  // namespace

void check_model(const LinearModel& model, const std::string& file, int sensor_capacity) {
  check_channels(model.states, "states", 1, max_states, file);
  check_channels(model.controls, "controls", 0, max_actuators, file);
  check_channels(model.health, "health", 1, max_health, file);
  check_channels(model.sensors, "sensors", 1, sensor_capacity, file);
  check_channels(model.auxiliary, "auxiliary", 0, max_auxiliary, file);
  if (!(model.sample_time_s > 0.0) || !std::isfinite(model.sample_time_s)) {
    files::throw_defect(file, "sample_time_s", files::shown(model.sample_time_s), "a number above 0",
                        "Give the sample time in seconds");
  }
  check_matrices(model, file);
  check_length(model.engine_type, max_name_length, "engine_type", file);
  check_length(model.engine_hash, hash_length, "engine_hash", file);
  check_positive(model.health_sigma, "health", "sigma", "Give the standard deviation over the fleet", file);
  check_health_sigma(model, file);
  if (!(model.sample_time_s >= 1e-4 && model.sample_time_s <= 10.0)) {
    files::throw_defect(file, "sample_time_s", files::shown(model.sample_time_s), "1e-4 to 10 s",
                        "Give the sample time in seconds");
  }
  check_optional(model.sensor_resolution, model, "resolution", file);
  check_optional(model.sensor_update_period_s, model, "update_period_s", file);
  check_positive(model.sensor_noise_sigma, "sensors", "noise_sigma",
                 "Give the standard deviation of one sample's noise", file);
  check_covariance(model.process_noise, "process_noise", "Give the covariance of w per sample", file);
  if (model.linearisation_error.size() > 0) {
    check_covariance(model.linearisation_error, "linearisation_error",
                     "Give the second moment of [y; z] minus its linear value over the fleet, or leave it out", file);
  }
  check_units(model, file);
  check_stability(model, file);
}

}  // namespace ehm::linear_model
