// SPDX-License-Identifier: Apache-2.0
#include "monitor/diagnosis/fault_signatures.h"

#include <algorithm>
#include <cmath>

#include "deploy/runtime/numbers/decompositions.h"
#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/design/closed_loop.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::monitor {

namespace {

constexpr double horizon_s = 3.0;
constexpr int most_ages = 512;
constexpr double no_mean = 0.05;  // noise sigmas: over three seconds it stays below what is noticed
// A component that breaks may lose more than wear takes in a life, but hardly 15 %: steps of health are expected
// within so many standard deviations of the fleet. It decides between a sensor and an absurdly large component step.
constexpr double step_sigmas = 2.0;

/// The engine in scaled units, discrete.
struct Plant {
  Eigen::MatrixXd A, L, C, M;
  Eigen::VectorXd noise_sigma, health_sigma;
  Eigen::MatrixXd process_noise;
  Eigen::MatrixXd fleet;  ///< [H Ph^1/2, root of Lambda_yy]: steady sensors per unknown of the fleet
};

Plant plant_of(const design::Design& design) {
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const Eigen::Index n = model.A.rows();
  Plant plant{design.full.A.topLeftCorner(n, n),
              {},
              model.C,
              model.M,
              model.sensor_noise_sigma,
              model.health_sigma,
              model.process_noise,
              {}};
  // The steady state is the same in either time form: L = (I - A) X.
  const estimation::SteadyGain steady = estimation::steady_gain(model);
  plant.L = (Eigen::MatrixXd::Identity(n, n) - plant.A) * steady.X;
  plant.fleet = steady.H * model.health_sigma.asDiagonal();
  if (model.linearisation_error.rows() > 0) {
    const Eigen::Index m = model.C.rows(), p = plant.fleet.cols();
    plant.fleet.conservativeResize(m, p + m);
    plant.fleet.rightCols(m) = linear_model::covariance_root(model.linearisation_error.topLeftCorner(m, m));
  }
  return plant;
}

/// Inverse of S without the directions B of a constant mean: S^-1 - S^-1 B (B^T S^-1 B)^-1 B^T S^-1. `mean`: of the
/// innovations per unknown of the fleet.
Eigen::MatrixXd blind_inverse(const Eigen::MatrixXd& S, const Eigen::MatrixXd& mean, const Eigen::VectorXd& sigma) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(sigma.cwiseInverse().asDiagonal() * mean, Eigen::ComputeThinU);
  const Eigen::Index blind = (svd.singularValues().array() > no_mean).count();
  const Eigen::MatrixXd B = sigma.asDiagonal() * svd.matrixU().leftCols(blind), inverse = S.inverse();
  if (blind == 0) return inverse;
  const Eigen::MatrixXd of_mean = B.transpose() * inverse * B;
  return inverse - inverse * B * of_mean.inverse() * B.transpose() * inverse;
}

/// S of the used sensors, and its inverse, with zeros elsewhere.
void add_noise(FaultSignatures& s, const design::SubsetDesign& set, const Plant& plant,
               const Eigen::MatrixXd& closed_loop) {
  const Eigen::MatrixXd R = plant.noise_sigma.cwiseAbs2().asDiagonal();
  const Eigen::MatrixXd& Q = plant.process_noise;
  const Eigen::MatrixXd entry = design::process_noise_entry(set, Q.rows());
  const Eigen::MatrixXd state =
      linear_model::stationary_covariance(closed_loop, set.K * R * set.K.transpose() + entry * Q * entry.transpose());
  const Eigen::MatrixXd prediction = set.C * set.A;
  const Eigen::MatrixXd S = prediction * state * prediction.transpose() + plant.C * Q * plant.C.transpose() + R;
  s.inverse_S.setZero(s.sensors, s.sensors);
  const Eigen::MatrixXd residual =
      Eigen::MatrixXd::Identity(s.sensors, s.sensors) - prediction * design::settled(closed_loop, set.K);
  s.inverse_S(set.sensors, set.sensors) = blind_inverse(
      S(set.sensors, set.sensors), residual(set.sensors, Eigen::all) * plant.fleet, plant.noise_sigma(set.sensors));
  s.innovation_sigma.setOnes(s.sensors);
  for (const int i : set.sensors) s.innovation_sigma(i) = std::sqrt(S(i, i));
}

/// y[a] of all hypotheses, m x (m+p); advances the engine's states x, n x (m+p).
Eigen::MatrixXd measured(const Plant& plant, Eigen::MatrixXd& x) {
  const Eigen::Index m = plant.C.rows(), p = plant.M.cols();
  Eigen::MatrixXd y = plant.C * x;
  y.leftCols(m).diagonal() += plant.noise_sigma;
  y.rightCols(p) += plant.M;
  x = (plant.A * x).eval();
  x.rightCols(p) += plant.L;
  return y;
}

FaultSignatures signatures(const design::SubsetDesign& set, const Plant& plant, int ages) {
  const Eigen::Index m = plant.C.rows(), p = plant.M.cols(), size = set.A.rows();
  FaultSignatures s;
  s.sensors = static_cast<int>(m);
  s.hypotheses = static_cast<int>(m + p);
  s.ages = ages;
  const Eigen::MatrixXd prediction = set.C * set.A;
  // Summed in this order, not as design::closed_loop does: earlier flights are estimated to the bit as they were.
  const Eigen::MatrixXd closed_loop = set.A - set.K * prediction;
  add_noise(s, set, plant, closed_loop);

  s.weight.resize(m + p, m * ages);
  s.information.resize(m + p, ages);
  s.state.resize(size, m * ages);
  Eigen::VectorXd information = Eigen::VectorXd::Zero(m + p);
  for (Eigen::Index j = 0; j < p; ++j) information(m + j) = 1.0 / std::pow(step_sigmas * plant.health_sigma(j), 2);
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(plant.A.rows(), m + p), xi = Eigen::MatrixXd::Zero(size, m + p);
  for (int a = 0; a < ages; ++a) {
    const Eigen::MatrixXd y = measured(plant, x);
    const Eigen::MatrixXd g = y - prediction * xi;
    xi = (closed_loop * xi + set.K * y).eval();
    const Eigen::MatrixXd weight = s.inverse_S * g;
    information += weight.cwiseProduct(g).colwise().sum().transpose();
    s.weight.middleCols(m * a, m) = weight.transpose();
    s.information.col(a) = information;
    s.state.middleCols(m * a, m) = xi.leftCols(m);
  }
  s.steady_state = design::settled(closed_loop, set.K * plant.noise_sigma.asDiagonal());
  return s;
}

}  // namespace

std::shared_ptr<const FaultTables> fault_tables(const design::Design& design) {
  const Plant plant = plant_of(design);
  const double T = design.model.sample_time_s;
  const int ages = static_cast<int>(std::clamp(std::round(horizon_s / T), 8.0, static_cast<double>(most_ages)));
  const auto made = [&](const design::SubsetDesign& set) {
    FaultSignatures s = signatures(set, plant, ages);
    s.settling_samples = set.settling_samples(T);
    return s;
  };
  auto tables = std::make_shared<FaultTables>();
  tables->full = made(design.full);
  for (const auto& set : design.missing) {
    tables->missing.emplace_back();
    if (set) tables->missing.back() = made(*set);
  }
  tables->sensor_scale = design.scaling.sensor;
  tables->noise_sigma = design.model.sensor_noise_sigma;
  tables->health_scale = design.scaling.health;
  return tables;
}

}  // namespace ehm::monitor
