// SPDX-License-Identifier: Apache-2.0
#include "monitor/estimation/steady_gain.h"

#include <sstream>
#include <stdexcept>

#include "deploy/runtime/numbers/decompositions.h"

namespace ehm::estimation {

SteadyGain steady_gain(const linear_model::LinearModel& model) {
  const Eigen::Index n = model.A.rows(), p = model.L.cols();
  if (model.M.cols() != p || model.N.cols() != p || model.C.cols() != n || model.F.cols() != n)
    throw std::invalid_argument(
        "steady gain: L, M, N must have a column for each health parameter, C and F for each state");
  // continuous: 0 = A x + L h; discrete: (I-A) x = L h
  const Eigen::MatrixXd dynamics =
      model.discrete ? Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n) - model.A) : Eigen::MatrixXd(-model.A);
  SteadyGain gain;
  gain.X = dynamics.partialPivLu().solve(model.L);
  const double residual = (dynamics * gain.X - model.L).norm();
  const double size = dynamics.norm() * gain.X.norm() + model.L.norm();
  if (!(residual <= 1e-9 * size)) {
    std::ostringstream message;
    message << "steady state of " << (model.discrete ? "(I-A) X = L" : "-A X = L") << ": residual " << residual
            << " of " << size << "; A has an eigenvalue at the integrator, so that health has no steady effect";
    throw std::runtime_error(message.str());
  }
  gain.H = model.C * gain.X + model.M;
  gain.Hz = model.F * gain.X + model.N;
  return gain;
}

}  // namespace ehm::estimation
