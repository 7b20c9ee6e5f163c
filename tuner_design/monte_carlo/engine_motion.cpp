// SPDX-License-Identifier: Apache-2.0
#include "tuner_design/monte_carlo/engine_motion.h"

#include "engine_sim/linear_model/stationary_covariance.h"
#include "monitor/estimation/linear/matrix_vector_product.h"

namespace ehm::tuner_design {

using estimation::StateVector;

namespace {

/// x += root n, n ~ N(0, I)
template <class Matrix>
void add_random(const Matrix& root, RandomStream& random, StateVector& x) {
  StateVector n(x.size());
  for (double& each : n) each = random.normal();
  estimation::add_product(root, n.data(), x.data());
}

}  // namespace

EngineMotion::EngineMotion(const linear_model::LinearModel& discrete, bool process_noise)
    : moves_(process_noise),
      A_(discrete.A),
      root_(linear_model::covariance_root(discrete.process_noise)),
      start_(linear_model::covariance_root(linear_model::stationary_covariance(discrete.A, discrete.process_noise))),
      C_(discrete.C),
      F_(discrete.F) {}

StateVector EngineMotion::begin(RandomStream& random) const {
  StateVector dx = StateVector::Zero(A_.rows());
  if (moves_) add_random(start_, random, dx);
  return dx;
}

void EngineMotion::advance(StateVector& dx, RandomStream& random) const {
  if (!moves_) return;
  StateVector next = StateVector::Zero(dx.size());
  estimation::add_product(A_, dx.data(), next.data());
  add_random(root_, random, next);
  dx = next;
}

void EngineMotion::add_to_sensors(estimation::SensorVector& dy, const StateVector& dx) const {
  if (moves_) estimation::add_product(C_, dx.data(), dy.data());
}

void EngineMotion::add_to_auxiliary(estimation::AuxiliaryVector& z, const StateVector& dx) const {
  if (moves_) estimation::add_product(F_, dx.data(), z.data());
}

}  // namespace ehm::tuner_design
