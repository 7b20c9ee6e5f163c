#include "tuner_design/monte_carlo/engine_motion.h"

#include "monitor/estimation/matrix_vector_product.h"
#include "monitor/estimation/stationary_covariance.h"

namespace ehm::bench {

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

EngineMotion::EngineMotion(const estimation::LinearModel& discrete, bool process_noise)
    : moves_(process_noise),
      A_(discrete.A),
      root_(estimation::covariance_root(discrete.process_noise)),
      start_(estimation::covariance_root(estimation::stationary_covariance(discrete.A, discrete.process_noise))),
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

}  // namespace ehm::bench
