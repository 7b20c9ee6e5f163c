// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/map_experiment.h"

#include "deploy/runtime/numbers/index.h"
#include "engine_sim/linear_model/discretise.h"
#include "monitor/estimation/steady_gain.h"
#include "tuner_design/monte_carlo/engine_average.h"
#include "tuner_design/monte_carlo/random_stream.h"
#include "tuner_design/theory/map_estimator.h"

namespace ehm::tuner_design {
namespace {

/// Everything scaled.
struct Snapshots {
  linear_model::LinearModel model;
  estimation::SteadyGain steady, steady_of_controls;  ///< answers of sensors and outputs to health and to u
  Eigen::MatrixXd Ph, R;
};

Snapshots snapshots_of(const design::Design& design) {
  Snapshots snapshots;
  snapshots.model = linear_model::scaled(discretise(design.model), design.scaling);
  snapshots.steady = estimation::steady_gain(snapshots.model);
  linear_model::LinearModel controlled = snapshots.model;
  controlled.L = controlled.B, controlled.M = controlled.D, controlled.N = controlled.G;
  snapshots.steady_of_controls = estimation::steady_gain(controlled);
  snapshots.Ph = snapshots.model.health_sigma.cwiseAbs2().asDiagonal();
  snapshots.R = snapshots.model.sensor_noise_sigma.cwiseAbs2().asDiagonal();
  return snapshots;
}

Experiment theory_of(const Eigen::MatrixXd& E, const Snapshots& s) {
  Experiment result;
  const Eigen::MatrixXd& Hz = s.steady.Hz;
  const Eigen::MatrixXd error = snapshot_error_covariance(E, s.steady.H, s.Ph, s.R);
  result.theory = {error.diagonal(), (Hz * error * Hz.transpose()).diagonal()};
  result.settled = result.theory;
  const Eigen::Index m = E.cols(), r = Hz.rows();
  result.linearisation = {Eigen::VectorXd::Zero(E.rows()), Eigen::VectorXd::Zero(r)};
  const Eigen::MatrixXd& Lambda = s.model.linearisation_error;
  if (Lambda.size() == 0) return result;
  Eigen::MatrixXd response(r, m + r);
  response << Hz * E, -Eigen::MatrixXd::Identity(r, r);
  result.linearisation.health = (E * Lambda.topLeftCorner(m, m) * E.transpose()).diagonal();
  result.linearisation.auxiliary = (response * Lambda * response.transpose()).diagonal();
  return result;
}

/// [squared errors of h and z | their sums].
void squared_errors(const Eigen::VectorXd& health_error, const Eigen::VectorXd& auxiliary_error,
                    Eigen::Ref<Eigen::VectorXd> numbers) {
  numbers << health_error.cwiseAbs2(), auxiliary_error.cwiseAbs2(), health_error.squaredNorm(),
      auxiliary_error.squaredNorm();
}

void fill_measured(Experiment& result, const EngineAverage& average, Eigen::Index at) {
  const Eigen::Index p = result.theory.health.size(), r = result.theory.auxiliary.size();
  const auto by_channel = [&](const Eigen::VectorXd& numbers) {
    return design::ErrorByChannel{numbers.segment(at, p), numbers.segment(at + p, r)};
  };
  result.engines = average.engines;
  result.without_steady_point = average.left_out;
  result.experiment = by_channel(average.mean);
  result.standard_error = by_channel(average.standard_error);
  result.standard_error_of_total = {average.standard_error(at + p + r), average.standard_error(at + p + r + 1)};
}

}  // namespace

std::vector<Experiment> map_experiment(const design::Design& design, const Eigen::MatrixXd& V, const Truth& truth,
                                       const MapOptions& options, const std::function<void(std::size_t)>& done) {
  const Snapshots s = snapshots_of(design);
  const Eigen::MatrixXd full = full_map_gain(s.steady.H, s.Ph, s.R);
  const Eigen::MatrixXd reduced = reduced_map_gain(s.steady.H, s.Ph, s.R, V);
  const Eigen::Index p = s.model.L.cols(), m = s.model.C.rows(), block = p + s.model.F.rows() + 2;

  const auto snapshot = [&](std::size_t index, Eigen::VectorXd& numbers) {
    RandomStream random(options.seed, index);
    Eigen::VectorXd h(p), y(m);
    for (Eigen::Index i = 0; i < p; ++i) h(i) = s.model.health_sigma(i) * random.normal();
    const std::optional<EngineInBalance> engine = truth.engine(h.cwiseProduct(design.scaling.health));
    if (!engine) return false;
    y = engine->sensors.cwiseQuotient(design.scaling.sensor) - s.steady_of_controls.H * engine->controls;
    for (Eigen::Index i = 0; i < m; ++i) y(i) += s.model.sensor_noise_sigma(i) * random.normal();
    const Eigen::VectorXd z =
        engine->auxiliary.cwiseQuotient(design.scaling.auxiliary) - s.steady_of_controls.Hz * engine->controls;
    Eigen::Index at = 0;
    for (const Eigen::MatrixXd* E : {&full, &reduced}) {
      const Eigen::VectorXd estimate = *E * y;
      squared_errors(estimate - h, s.steady.Hz * estimate - z, numbers.segment(at, block));
      at += block;
    }
    return true;
  };
  const EngineAverage average = average_over_engines(options.engines, 2 * block, options.threads, snapshot, done);

  std::vector<Experiment> results{theory_of(full, s), theory_of(reduced, s)};
  results[0].estimator = "MAP, full order";
  results[1].estimator = "MAP, on the tuners";
  for (std::size_t i = 0; i < results.size(); ++i) {
    fill_measured(results[i], average, as_index(i) * block);
    results[i].truth = truth.description + ", one snapshot each";
    results[i].nonlinear = truth.nonlinear;
    if (!truth.nonlinear) results[i].linearisation.health.setZero(), results[i].linearisation.auxiliary.setZero();
  }
  return results;
}

}  // namespace ehm::tuner_design
