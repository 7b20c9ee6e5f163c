// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/make_filter.h"

#include "deploy/runtime/numbers/decompositions.h"
#include "deploy/runtime/numbers/index.h"
#include "monitor/estimation/steady_gain.h"

namespace ehm::design {
namespace {

using estimation::SteadyGain;
using estimation::SubsetGain;
using linear_model::Scaling;

/// Re-reference of [x; q] from design a to design b.
Eigen::MatrixXd transfer(const SubsetDesign& a, const SubsetDesign& b, const Eigen::VectorXd& noise_sigma,
                         const SteadyGain& steady) {
  const Eigen::Index n = steady.X.rows(), ta = a.V.rows(), tb = b.V.rows();
  const Eigen::MatrixXd H_b = noise_sigma(b.sensors).cwiseInverse().asDiagonal() * steady.H(b.sensors, Eigen::all);
  // T = (H_b W_b)^+ H_b W_a, in units of noise
  const Eigen::MatrixXd T = (H_b * b.W).completeOrthogonalDecomposition().solve(H_b * a.W);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n + tb, n + ta);
  result.topLeftCorner(n, n).setIdentity();
  result.topRightCorner(n, ta) = steady.X * (b.W * T - a.W);
  result.bottomRightCorner(tb, ta) = T;
  return result;
}

/// sqrt of the diagonal of a scaled covariance, in channel units.
Eigen::VectorXd channel_sigma(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& scale) {
  return covariance.diagonal().cwiseSqrt().cwiseProduct(scale);
}

SubsetGain channel_unit_gain(const SubsetDesign& design, const SubsetDesign& full, const linear_model::Scaling& scaling,
                             const linear_model::LinearModel& model, const SteadyGain& steady) {
  const Eigen::Index n = model.A.rows(), t = design.V.rows();
  const Eigen::Index p = model.L.cols(), r = model.F.rows();
  const auto health = scaling.health.asDiagonal();
  const auto auxiliary = scaling.auxiliary.asDiagonal();
  SubsetGain gain;
  for (const int sensor : design.sensors) gain.sensors.set(as_size(sensor));
  gain.A = design.A;
  gain.B = design.B;
  gain.C = scaling.sensor.asDiagonal() * design.C;
  gain.K = design.K * scaling.sensor.cwiseInverse().asDiagonal();
  gain.health_output.setZero(p, n + t);  // Th = [0, Rh]
  gain.health_output.rightCols(t) = health * design.health_readout;
  gain.auxiliary_output.resize(r, n + t);  // Tz = [F, Rz]
  gain.auxiliary_output.leftCols(n) = auxiliary * model.F;
  gain.auxiliary_output.rightCols(t) = auxiliary * design.auxiliary_readout;
  gain.from_full = transfer(full, design, model.sensor_noise_sigma, steady);
  gain.to_full = transfer(design, full, model.sensor_noise_sigma, steady);
  gain.innovation_variance = design.innovation_variance.cwiseProduct(scaling.sensor.cwiseAbs2());
  gain.health_sigma_total = channel_sigma(design.health_total_covariance, scaling.health);
  gain.health_sigma_filter = channel_sigma(design.health_filter_covariance, scaling.health);
  gain.auxiliary_sigma_total = channel_sigma(design.auxiliary_total_covariance, scaling.auxiliary);
  gain.auxiliary_sigma_filter = channel_sigma(design.auxiliary_filter_covariance, scaling.auxiliary);
  gain.health_noise_covariance = health * design.health_noise_covariance * health;
  gain.auxiliary_noise_covariance = auxiliary * design.auxiliary_noise_covariance * auxiliary;
  return gain;
}

}  // namespace

estimation::TunerFilter make_filter(const Design& design) {
  const linear_model::LinearModel model = linear_model::scaled(design.model, design.scaling);
  const SteadyGain steady = estimation::steady_gain(model);
  estimation::TunerFilterModel flying;
  flying.D = design.model.D;
  flying.G = design.model.G;
  flying.health_trim.resize(as_index(model.health.size()));
  flying.auxiliary_trim.resize(as_index(model.auxiliary.size()));
  for (std::size_t i = 0; i < model.health.size(); ++i) {
    flying.health_trim(as_index(i)) = design.model.health[i].trim;
  }
  for (std::size_t i = 0; i < model.auxiliary.size(); ++i) {
    flying.auxiliary_trim(as_index(i)) = design.model.auxiliary[i].trim;
  }
  flying.states = static_cast<int>(model.states.size());
  flying.full = channel_unit_gain(design.full, design.full, design.scaling, model, steady);
  for (const auto& subset : design.missing) {
    flying.missing.emplace_back();
    if (subset) flying.missing.back() = channel_unit_gain(*subset, design.full, design.scaling, model, steady);
  }
  return estimation::TunerFilter(std::move(flying));
}

}  // namespace ehm::design
