// SPDX-License-Identifier: Apache-2.0
#include "monitor/design/fleet_unknowns.h"

#include "engine_sim/linear_model/stationary_covariance.h"

namespace ehm::design {

FleetUnknowns fleet_unknowns(const linear_model::LinearModel& model, const estimation::SteadyGain& steady) {
  const Eigen::Index p = model.L.cols(), m = model.C.rows(), r = model.F.rows();
  const Eigen::Index extra = model.linearisation_error.rows();
  const auto sigma = model.health_sigma.asDiagonal();
  FleetUnknowns unknowns;
  unknowns.health.setZero(p, p + extra);
  unknowns.health.leftCols(p) = sigma.toDenseMatrix();
  unknowns.sensors.resize(m, p + extra);
  unknowns.auxiliary.resize(r, p + extra);
  unknowns.sensors.leftCols(p) = steady.H * sigma;
  unknowns.auxiliary.leftCols(p) = steady.Hz * sigma;
  if (extra > 0) {
    const Eigen::MatrixXd nonlinear = linear_model::covariance_root(model.linearisation_error);
    unknowns.sensors.rightCols(extra) = nonlinear.topRows(m);
    unknowns.auxiliary.rightCols(extra) = nonlinear.bottomRows(r);
  }
  return unknowns;
}

}  // namespace ehm::design
